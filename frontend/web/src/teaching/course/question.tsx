/** A question with one answer, which can be given once. */
import { useState } from "preact/hooks";
import { text } from "../../core/text/en";
import { answer, type TaskProps } from "./lesson";
import { Results } from "./results";

const words = text.lesson;

export function Question({ of, onDone }: Omit<TaskProps, "exercise">) {
  const [chosen, setChosen] = useState("");
  const [isSent, setSent] = useState(false);
  const given = of.answer;
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
      <fieldset disabled={given !== null}>
        <legend class="visually-hidden">{of.title}</legend>
        {of.options.map((one) => (
          <label key={one.name} class="line lesson-option">
            <input
              type="radio"
              name={of.name}
              value={one.name}
              checked={(given ?? chosen) === one.name}
              onChange={() => setChosen(one.name)}
            />
            <span>{one.text}</span>
          </label>
        ))}
      </fieldset>
      {given === null && (
        <>
          <small>{words.chosenOnce}</small>
          <button type="submit" class="button is-primary" disabled={chosen === "" || isSent}>
            {words.choose}
          </button>
        </>
      )}
      <Results of={of} results={of.results} run={null} />
    </form>
  );
}
