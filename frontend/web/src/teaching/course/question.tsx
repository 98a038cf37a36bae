/** A question with one answer, which can be given once. */
import { useState } from "preact/hooks";
import { t } from "../../core/text/t";
import { answer, type TaskProps } from "./lesson";
import { Results } from "./results";

export function Question({ of, onDone }: Omit<TaskProps, "exercise">) {
  const [chosen, setChosen] = useState("");
  const [isSent, setSent] = useState(false);
  const savedAnswer = of.answer;
  return (
    <form
      class="stack lesson-form"
      onSubmit={(event) => {
        event.preventDefault();
        setSent(true);
        void answer(of, chosen).then(() => {
          setSent(false);
          requestAnimationFrame(onDone);
        });
      }}
    >
      <fieldset class="stack tight" disabled={savedAnswer !== null}>
        <legend class="visually-hidden">{of.title}</legend>
        {of.options.map((option) => (
          <label key={option.name} class="line check">
            <input
              type="radio"
              name={of.name}
              value={option.name}
              checked={(savedAnswer ?? chosen) === option.name}
              onChange={() => setChosen(option.name)}
            />
            <span>{option.text}</span>
          </label>
        ))}
      </fieldset>
      {savedAnswer === null && (
        <>
          <small>{t("lesson.chosenOnce")}</small>
          <button type="submit" class="button is-primary" disabled={chosen === "" || isSent}>
            {t("lesson.choose")}
          </button>
        </>
      )}
      <Results of={of} results={of.results} run={null} />
    </form>
  );
}
