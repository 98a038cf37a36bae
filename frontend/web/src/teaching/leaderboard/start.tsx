import { useEffect, useRef, useState } from "preact/hooks";
import { isJobRunning, JobProgress } from "../../core/jobs/progress";
import { isClass, mayCall } from "../../core/state/access";
import { personName, setPersonName } from "../../core/state/preferences";
import { t } from "../../core/text/t";
import { findFault, LawText } from "../../core/widgets/lawtext";
import EXAMPLE from "./example.py?raw";
import {
  board,
  cancel,
  entries,
  existingEntryKey,
  hasSubmittedEntry,
  isBusy,
  job,
  measureInstalledLaws,
  submit,
} from "./leaderboard";

const LONGEST_NAME = 60;
const ENDING = /\.py$/i;

/** Progress of the measurement, or its outcome. */
function Progress() {
  const now = job.value;
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => {
    box.current?.scrollIntoView({ block: "nearest" });
  }, [now?.id, isJobRunning(now)]);
  if (now === null) return null;
  const failed = now.status === "failed";
  return (
    <div ref={box} class="surface card">
      <h3>
        {isJobRunning(now) && !hasSubmittedEntry.value
          ? t("leaderboard.measuring", { title: now.title })
          : t("leaderboard.measured", { title: now.title })}
      </h3>
      {hasSubmittedEntry.value && <p class="hint">{t("leaderboard.labFollows")}</p>}
      {failed ? (
        <p class="problem as-written" role="alert">
          <strong>{t("leaderboard.failed")}</strong> {now.problem} {t("leaderboard.failedHint")}
        </p>
      ) : (
        <JobProgress
          job={now}
          done={t("leaderboard.runs", { done: now.done, total: now.total || "…" })}
          total={now.total || 1}
          label={t("leaderboard.measuring", { title: now.title })}
          onCancel={() => void cancel()}
        />
      )}
    </div>
  );
}

/** The text of a law, pasted or from a file, its name and its author. */
function Form() {
  const [name, setName] = useState("");
  const [author, setAuthor] = useState(personName.peek());
  const [law, setLaw] = useState("");
  const nameBy = (file: string) => {
    if (name === "") setName(file.replace(ENDING, "").slice(0, LONGEST_NAME));
  };
  const existing = entries.value.find(({ key }) => key === existingEntryKey.value);
  return (
    <form
      class="surface card stack form"
      onSubmit={(event) => {
        event.preventDefault();
        if (!isClass.peek()) setPersonName(author.trim());
        void submit({ name, author, law });
      }}
    >
      <h3>{t("leaderboard.submit")}</h3>
      <p class="hint">{t("leaderboard.submitHint", { runs: board.value?.runs ?? 0 })}</p>
      <label>
        <span>{t("leaderboard.name")}</span>
        <input
          type="text"
          required
          maxLength={LONGEST_NAME}
          value={name}
          onInput={({ currentTarget }) => setName(currentTarget.value)}
        />
      </label>
      {!isClass.value && (
        <label>
          <span>{t("leaderboard.author")}</span>
          <input
            type="text"
            maxLength={LONGEST_NAME}
            autocomplete="name"
            value={author}
            onInput={({ currentTarget }) => setAuthor(currentTarget.value)}
          />
        </label>
      )}
      <LawText
        law={law}
        onLaw={setLaw}
        onFile={nameBy}
        start={EXAMPLE}
        startWord={t("leaderboard.example")}
      />
      <p class="hint">{t("leaderboard.law")}</p>
      <div class="row">
        <button
          type="submit"
          class="button is-primary"
          disabled={
            law.trim() === "" ||
            findFault(law) !== "" ||
            isBusy.value !== "" ||
            isJobRunning(job.value)
          }
        >
          {t("leaderboard.send")}
        </button>
      </div>
      <p role="status" hidden={existingEntryKey.value === ""}>
        {existingEntryKey.value !== "" &&
          (existing ? t("leaderboard.knownAs", { name: existing.name }) : t("leaderboard.known"))}
      </p>
    </form>
  );
}

/** How to submit a law, obstacles on this machine, and progress of the current one. */
export function Start() {
  const now = board.value;
  if (now === null) return null;
  const isMissing = now.missing.length > 0;
  return (
    <>
      <Progress />
      {now.not_isolated !== null ? (
        <div class="surface card">
          <h3>{t("leaderboard.submit")}</h3>
          <p class="problem">{t("leaderboard.notIsolated")}</p>
          <p class="hint">{now.not_isolated}</p>
        </div>
      ) : !mayCall("post", "/leaderboard/submissions") ? (
        <p class="surface card hint">{t("leaderboard.observer")}</p>
      ) : (
        <Form />
      )}
      {isMissing && mayCall("post", "/leaderboard/laws") && (
        <div class="surface card">
          <h3>{t("leaderboard.lab")}</h3>
          <p class="hint">{t("leaderboard.missing", { count: now.missing.length })}</p>
          <button
            type="button"
            class="button"
            disabled={isJobRunning(job.value)}
            onClick={() => void measureInstalledLaws()}
          >
            {t("leaderboard.measureLab")}
          </button>
        </div>
      )}
      <div class="surface card">
        <h3>{t("leaderboard.script")}</h3>
        <p class="hint">{t("leaderboard.scriptHint")}</p>
        <pre>{t("leaderboard.command")}</pre>
      </div>
    </>
  );
}
