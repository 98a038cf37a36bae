/** The student's own law: a file or text, tried at once, and stored until it is submitted. */
import { useMemo, useState } from "preact/hooks";
import type { Exercise } from "../../core/api/course";
import { text } from "../../core/text/en";
import { findFault, LawText } from "../../core/widgets/lawtext";
import { isBusy, tryLaw } from "./lesson";

const words = text.lesson.law;

const TONES: Readonly<Record<string, string>> = { held: "is-good", failed: "is-bad" };

/** The first program in a step's text, used as initial text; "" if there is none. */
const findStart = (html: string): string =>
  new DOMParser().parseFromString(html, "text/html").querySelector("pre > code")?.textContent ?? "";

function Trial({ savedLaw }: { savedLaw: NonNullable<Exercise["law"]> }) {
  return (
    <div class={`note stack small ${TONES[savedLaw.verdict] ?? "is-warn"}`}>
      <p>
        <strong>{words.verdicts[savedLaw.verdict]}.</strong> {savedLaw.feedback}
      </p>
      {savedLaw.output.trim() !== "" && (
        <>
          <h4>{words.output}</h4>
          <pre>{savedLaw.output.trim()}</pre>
        </>
      )}
    </div>
  );
}

export function OwnLaw({ savedLaw, html }: { savedLaw: Exercise["law"]; html: string }) {
  const [law, setLaw] = useState(savedLaw?.text ?? "");
  const [isTrying, setTrying] = useState(false);
  const start = useMemo(() => findStart(html), [html]);
  return (
    <form
      class="stack lesson-form"
      aria-label={words.label}
      onSubmit={async (event) => {
        event.preventDefault();
        setTrying(true);
        await tryLaw(law);
        setTrying(false);
      }}
    >
      <LawText law={law} onLaw={setLaw} start={start} startWord={words.start} />
      <button
        type="submit"
        class="button is-primary"
        title={words.tryHint}
        disabled={law.trim() === "" || findFault(law) !== "" || isBusy.value !== ""}
      >
        {words.try}
      </button>
      <div class="block stack" role="status">
        {isTrying && <p class="note is-accent">{words.trying}</p>}
        {!isTrying && savedLaw && <Trial savedLaw={savedLaw} />}
        {!isTrying && savedLaw && savedLaw.text !== law && <p class="hint">{words.changed}</p>}
      </div>
    </form>
  );
}
