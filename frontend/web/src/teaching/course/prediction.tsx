/** Prediction of a number before the run that it is compared with. */
import { useState } from "preact/hooks";
import { text } from "../../core/text/en";
import { ErrorLine } from "../../core/widgets/form";
import { answer, type TaskProps } from "./lesson";
import { Results } from "./results";

const words = text.lesson;

const formatBound = (value: number) => String(Number(value.toPrecision(6)));

const isBegun = (draft: string) => !/^\s*[-+]?\s*$/.test(draft);

export function Prediction({ of, exercise, onDone }: TaskProps) {
  const [isChanging, setChanging] = useState(false);
  const [draft, setDraft] = useState("");
  const [isSent, setSent] = useState(false);
  const given = of.answer;
  const typed = isBegun(draft) ? Number(draft.replace(",", ".")) : null;
  const isWrong = typed !== null && !Number.isFinite(typed);
  const judge = exercise.parts.find(({ name }) => name === of.judged_by);
  const range = words.from(formatBound(of.low ?? 0), formatBound(of.high ?? 0), of.unit);
  if (given !== null && !isChanging) {
    return (
      <>
        <p class="note">
          <strong>{words.kept(String(given), of.unit)}</strong>{" "}
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
      class="stack lesson-form"
      onSubmit={(event) => {
        event.preventDefault();
        if (typed === null || isWrong) return;
        setSent(true);
        void answer(of, typed).then(() => {
          setSent(false);
          setChanging(false);
          requestAnimationFrame(onDone);
        });
      }}
    >
      <label>
        <span>{of.asks}</span>
        <span class="row lesson-number">
          <input
            type="text"
            inputMode="decimal"
            autocomplete="off"
            aria-invalid={isWrong}
            value={draft}
            onInput={({ currentTarget }) => setDraft(currentTarget.value)}
          />
          <span class="unit">{of.unit}</span>
        </span>
        <small>{range}</small>
      </label>
      <ErrorLine>{isWrong ? words.notANumber(draft.trim()) : ""}</ErrorLine>
      <button
        type="submit"
        class="button is-primary"
        disabled={isSent || typed === null || isWrong}
      >
        {words.keep}
      </button>
    </form>
  );
}
