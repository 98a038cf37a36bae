/** Prediction of a number before the run that it is compared with. */

import { useState } from "preact/hooks";
import { t } from "../../core/text/t";
import { formatInput } from "../../core/units";
import { NumberField } from "../../core/widgets/numberinput";
import { answer, type TaskProps } from "./lesson";
import { Results } from "./results";

const formatBound = (value: number) => formatInput(value, 6);

export function Prediction({ of, exercise, onDone }: TaskProps) {
  const [isChanging, setChanging] = useState(false);
  const [draft, setDraft] = useState<number | null>(null);
  const [isSent, setSent] = useState(false);
  const savedAnswer = of.answer;
  const judge = exercise.parts.find(({ name }) => name === of.judged_by);
  const range = t("lesson.from", {
    low: formatBound(of.low ?? 0),
    high: formatBound(of.high ?? 0),
    unit: of.unit && ` ${of.unit}`,
  });
  if (savedAnswer !== null && !isChanging) {
    return (
      <>
        <p class="note">
          <strong>
            {t("lesson.kept", { answer: savedAnswer ?? "", unit: of.unit && ` ${of.unit}` })}
          </strong>{" "}
          {of.is_final ? t("lesson.isKept") : t("lesson.keptHint")}
        </p>
        {!of.is_final && (
          <button type="button" class="button" onClick={() => setChanging(true)}>
            {t("lesson.change")}
          </button>
        )}
        <Results of={of} results={of.results} run={judge?.run_id ?? null} />
      </>
    );
  }
  return (
    <form
      class="stack form lesson-form"
      onSubmit={(event) => {
        event.preventDefault();
        if (draft === null) return;
        setSent(true);
        void answer(of, draft).then(() => {
          setSent(false);
          setChanging(false);
          requestAnimationFrame(onDone);
        });
      }}
    >
      <NumberField
        label={of.asks}
        unit={of.unit}
        min={of.low ?? undefined}
        max={of.high ?? undefined}
        value={draft}
        onInput={setDraft}
        below={<small>{range}</small>}
      />
      <button type="submit" class="button is-primary" disabled={isSent || draft === null}>
        {t("lesson.keep")}
      </button>
    </form>
  );
}
