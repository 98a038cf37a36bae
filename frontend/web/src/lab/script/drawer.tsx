import { signal } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import { type Call, calls, clearCalls } from "../../core/api/calls";
import { API } from "../../core/api/request";
import { t } from "../../core/text/t";
import { formatTime } from "../../core/units";
import { Choice, ErrorLine } from "../../core/widgets/form";
import { CopyButton, saveText } from "./copybutton";
import { makeExperimentScript, scriptProblem } from "./repeat";
import { LANGUAGES, type Language, toSnippet, toSnippets } from "./snippets";

const OPTIONS = LANGUAGES.map((value) => ({ value, label: t(`script.languages.${value}`) }));

const isDrawerOpen = signal(false);

export function toggleDrawer(): void {
  isDrawerOpen.value = !isDrawerOpen.peek();
}

function outcome({ status, timeS }: Call): string {
  if (status === null) return t("script.unreached");
  if (status >= 400) return t("script.refused", { status });
  return timeS === null ? "" : t("script.at", { time: formatTime(timeS) });
}

function CallRow({ call, language }: { call: Call; language: Language }) {
  const snippet = toSnippet(call, language, API);
  const isBad = call.status === null || call.status >= 400;
  return (
    <li class="line loose">
      <span class={`hint ${isBad ? "bad strong" : ""}`}>
        {isBad && <span aria-hidden="true">▲ </span>}
        {outcome(call)}
      </span>
      <code class="grow breaks small">{snippet}</code>
      <CopyButton
        class="quiet"
        read={() => snippet}
        label={t("script.copyOne", { what: `${call.method.toUpperCase()} ${call.path}` })}
      >
        {t("script.copy")}
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
  if (all.length === 0) return <p class="hint">{t("script.empty")}</p>;
  return (
    <ol
      ref={list}
      class="scroller calls"
      aria-label={t("script.list")}
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
  if (script !== null) saveText(script, t("script.fileName"));
}

/** The calls of this page as code, in a drawer below the lab. */
export function CallsDrawer() {
  const [language, setLanguage] = useState<Language>("python");
  if (!isDrawerOpen.value) return null;
  const isEmpty = calls.value.length === 0;
  return (
    <section class="column joined rigid drawer" aria-label={t("script.title")}>
      <div class="row">
        <h2>{t("script.title")}</h2>
        <Choice
          label={t("script.language")}
          options={OPTIONS}
          value={language}
          onChoose={(value) => setLanguage(value)}
        />
        <CopyButton
          class="quiet"
          disabled={isEmpty}
          read={() => toSnippets(calls.peek(), language, API)}
        >
          {t("script.copyAll")}
        </CopyButton>
        <button type="button" class="quiet" disabled={isEmpty} onClick={clearCalls}>
          {t("script.clear")}
        </button>
        <span class="grow" />
        <ExperimentButtons />
        <button
          type="button"
          class="button is-icon"
          aria-label={t("script.close")}
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
      <CopyButton
        class="button is-primary"
        hint={t("script.experimentHint")}
        read={makeExperimentScript}
      >
        {t("script.experiment")}
      </CopyButton>
      <button
        type="button"
        class="button"
        title={t("script.saveHint")}
        onClick={() => void saveExperiment()}
      >
        {t("script.save")}
      </button>
    </>
  );
}

export function CallsButton() {
  return (
    <button
      type="button"
      class="button is-icon"
      aria-label={t("script.open")}
      aria-expanded={isDrawerOpen.value}
      aria-keyshortcuts="p"
      title={t("script.openHint")}
      onClick={toggleDrawer}
    >
      <svg viewBox="0 0 16 16" aria-hidden="true">
        <path d="M5.3 3.2l1.1 1.1L2.7 8l3.7 3.7-1.1 1.1L.5 8zM10.7 3.2L9.6 4.3 13.3 8l-3.7 3.7 1.1 1.1L15.5 8z" />
      </svg>
    </button>
  );
}
