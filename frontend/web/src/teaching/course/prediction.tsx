/** Prediction of a number before the run that it is compared with. */
import { useState } from "preact/hooks";
import { text } from "../../core/text/en";
import { NumberField } from "../../core/widgets/numberinput";
import { answer, type TaskProps } from "./lesson";
import { Results } from "./results";

const words = text.lesson;

const formatBound = (value: number) => String(Number(value.toPrecision(6)));

export function Prediction({ of, exercise, onDone }: TaskProps) {
  const [isChanging, setChanging] = useState(false);
  const [draft, setDraft] = useState<number | null>(null);
  const [isSent, setSent] = useState(false);
  const savedAnswer = of.answer;
  const judge = exercise.parts.find(({ name }) => name === of.judged_by);
  const range = words.from(formatBound(of.low ?? 0), formatBound(of.high ?? 0), of.unit);
  if (savedAnswer !== null && !isChanging) {
    return (
      <>
        <p class="note">
          <strong>{words.kept(String(savedAnswer), of.unit)}</strong>{" "}
          {of.is_final ? words.isKept : words.keptHint}
        </p>
        {!of.is_final && (
          <button type="button" class="button" onClick={() => setChanging(true)}>
            {words.change}
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
        {words.keep}
      </button>
    </form>
  );
}
