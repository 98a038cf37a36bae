import { signal } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import { type Call, calls, clearCalls } from "../../core/api/calls";
import { API } from "../../core/api/request";
import { text } from "../../core/text/en";
import { formatTime } from "../../core/units";
import { Choice, ErrorLine } from "../../core/widgets/form";
import { CopyButton, saveText } from "./copybutton";
import { makeExperimentScript, scriptProblem } from "./repeat";
import { LANGUAGES, type Language, toSnippet, toSnippets } from "./snippets";

const words = text.script;
const OPTIONS = LANGUAGES.map((value) => ({ value, label: words.languages[value] }));

const isDrawerOpen = signal(false);

export function toggleDrawer(): void {
  isDrawerOpen.value = !isDrawerOpen.peek();
}

function outcome({ status, timeS }: Call): string {
  if (status === null) return words.unreached;
  if (status >= 400) return words.refused(status);
  return timeS === null ? "" : words.at(formatTime(timeS));
}

function CallRow({ call, language }: { call: Call; language: Language }) {
  const snippet = toSnippet(call, language, API);
  const isBad = call.status === null || call.status >= 400;
  return (
    <li>
      <span class={`hint ${isBad ? "bad strong" : ""}`}>
        {isBad && <span aria-hidden="true">▲ </span>}
        {outcome(call)}
      </span>
      <code>{snippet}</code>
      <CopyButton
        class="quiet"
        read={() => snippet}
        label={words.copyOne(`${call.method.toUpperCase()} ${call.path}`)}
      >
        {words.copy}
      </CopyButton>
    </li>
  );
}

/** The calls; scrolls to the newest, unless the user reads an older one. */
function CallList({ language }: { language: Language }) {
  const list = useRef<HTMLOListElement>(null);
  const isAtEnd = useRef(true);
  const all = calls.value;
  useEffect(() => {
    if (list.current && isAtEnd.current) list.current.scrollTop = list.current.scrollHeight;
  });
  if (all.length === 0) return <p class="hint">{words.empty}</p>;
  return (
    <ol
      ref={list}
      class="calls"
      aria-label={words.list}
      // biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls is reached by key
      tabIndex={0}
      onScroll={({ currentTarget: { scrollTop, scrollHeight, clientHeight } }) => {
        isAtEnd.current = scrollHeight - scrollTop - clientHeight < 8;
      }}
    >
      {all.map((call) => (
        <CallRow key={call.id} call={call} language={language} />
      ))}
    </ol>
  );
}

async function saveExperiment(): Promise<void> {
  const script = await makeExperimentScript();
  if (script !== null) saveText(script, words.fileName);
}

/** The calls of this page as code, in a drawer below the lab. */
export function CallsDrawer() {
  const [language, setLanguage] = useState<Language>("python");
  if (!isDrawerOpen.value) return null;
  const isEmpty = calls.value.length === 0;
  return (
    <section class="column joined rigid drawer" aria-label={words.title}>
      <div class="row drawer-head">
        <h2>{words.title}</h2>
        <Choice
          label={words.language}
          options={OPTIONS}
          value={language}
          onChoose={(value) => setLanguage(value)}
        />
        <CopyButton
          class="quiet"
          disabled={isEmpty}
          read={() => toSnippets(calls.peek(), language, API)}
        >
          {words.copyAll}
        </CopyButton>
        <button type="button" class="quiet" disabled={isEmpty} onClick={clearCalls}>
          {words.clear}
        </button>
        <span class="grow" />
        <ExperimentButtons />
        <button
          type="button"
          class="button is-icon"
          aria-label={words.close}
          onClick={toggleDrawer}
        >
          <span aria-hidden="true">✕</span>
        </button>
      </div>
      <ErrorLine>{scriptProblem.value}</ErrorLine>
      <CallList language={language} />
    </section>
  );
}

/** The script of the experiment, to copy or to save. */
function ExperimentButtons() {
  return (
    <>
      <CopyButton class="button is-primary" hint={words.experimentHint} read={makeExperimentScript}>
        {words.experiment}
      </CopyButton>
      <button
        type="button"
        class="button"
        title={words.saveHint}
        onClick={() => void saveExperiment()}
      >
        {words.save}
      </button>
    </>
  );
}

export function CallsButton() {
  return (
    <button
      type="button"
      class="button is-icon"
      aria-label={words.open}
      aria-expanded={isDrawerOpen.value}
      aria-keyshortcuts="p"
      title={words.openHint}
      onClick={toggleDrawer}
    >
      <svg viewBox="0 0 16 16" aria-hidden="true">
        <path d="M5.3 3.2l1.1 1.1L2.7 8l3.7 3.7-1.1 1.1L.5 8zM10.7 3.2L9.6 4.3 13.3 8l-3.7 3.7 1.1 1.1L15.5 8z" />
      </svg>
    </button>
  );
}
