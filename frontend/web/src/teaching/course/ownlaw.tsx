/** The student's own law: a file or text, tried at once, and stored until it is submitted. */
import { useMemo, useState } from "preact/hooks";
import type { Exercise } from "../../core/api/course";
import { t } from "../../core/text/t";
import { findFault, LawText } from "../../core/widgets/lawtext";
import { isBusy, tryLaw } from "./lesson";

const TONES: Readonly<Record<string, string>> = { held: "is-good", failed: "is-bad" };

/** The first program in a step's text, used as initial text; "" if there is none. */
const findStart = (html: string): string =>
  new DOMParser().parseFromString(html, "text/html").querySelector("pre > code")?.textContent ?? "";

function Trial({ savedLaw }: { savedLaw: NonNullable<Exercise["law"]> }) {
  return (
    <div class={`note stack small ${TONES[savedLaw.verdict] ?? "is-warn"}`}>
      <p>
        <strong>{t(`lesson.law.verdicts.${savedLaw.verdict}`)}.</strong> {savedLaw.feedback}
      </p>
      {savedLaw.output.trim() !== "" && (
        <>
          <h4>{t("lesson.law.output")}</h4>
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
      class="stack form lesson-form"
      aria-label={t("lesson.law.label")}
      onSubmit={async (event) => {
        event.preventDefault();
        setTrying(true);
        await tryLaw(law);
        setTrying(false);
      }}
    >
      <LawText law={law} onLaw={setLaw} start={start} startWord={t("lesson.law.start")} />
      <button
        type="submit"
        class="button is-primary"
        title={t("lesson.law.tryHint")}
        disabled={law.trim() === "" || findFault(law) !== "" || isBusy.value !== ""}
      >
        {t("lesson.law.try")}
      </button>
      <div class="block stack" role="status">
        {isTrying && <p class="note is-accent">{t("lesson.law.trying")}</p>}
        {!isTrying && savedLaw && <Trial savedLaw={savedLaw} />}
        {!isTrying && savedLaw && savedLaw.text !== law && (
          <p class="hint">{t("lesson.law.changed")}</p>
        )}
      </div>
    </form>
  );
}
