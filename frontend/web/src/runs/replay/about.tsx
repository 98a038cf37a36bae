import { useRef } from "preact/hooks";
import { t } from "../../core/text/t";
import type { Run } from "./data";

const MAX_ENTRIES = 200;

const isPlain = (value: unknown) => value === null || typeof value !== "object";

/** Any JSON value: simple ones as text, others as a list of names and values. */
function Value({ value }: { value: unknown }) {
  if (isPlain(value)) return <>{value === null ? t("replay.about.empty") : String(value)}</>;
  if (Array.isArray(value) && value.every(isPlain)) {
    return <>{value.map(String).join(", ") || t("replay.about.empty")}</>;
  }
  const entries = Object.entries(value as object);
  return (
    <dl>
      {entries.slice(0, MAX_ENTRIES).map(([key, inner]) => (
        <div key={key} class={isPlain(inner) ? "" : "is-group"}>
          <dt class={isPlain(inner) ? "" : "strong"}>
            {Array.isArray(value) ? Number(key) + 1 : key}
          </dt>
          <dd class="breaks">
            <Value value={inner} />
          </dd>
        </div>
      ))}
      {entries.length > MAX_ENTRIES && (
        <p>{t("replay.about.more", { count: entries.length - MAX_ENTRIES })}</p>
      )}
    </dl>
  );
}

export function Header({ run }: { run: Run }) {
  const dialog = useRef<HTMLDialogElement>(null);
  const facts = Object.entries(run.details).filter(([, value]) => value !== "" && isPlain(value));
  return (
    <header class="bar">
      <div>
        <h1 class="clip">{run.title}</h1>
        <p class="hint">
          {t("replay.name")}, {t("replay.recorded")}
        </p>
      </div>
      <dl class="grow small run-facts">
        {facts.slice(0, 4).map(([key, value]) => (
          <div key={key}>
            <dt>{key}</dt>
            <dd class="clip" title={String(value)}>
              {String(value)}
            </dd>
          </div>
        ))}
      </dl>
      <button type="button" class="button" onClick={() => dialog.current?.showModal()}>
        {t("replay.about.open")}
      </button>
      <dialog ref={dialog} class="floating scroller about" aria-label={t("replay.about.open")}>
        <div class="spread tabular about-head">
          <h2>{t("replay.about.open")}</h2>
          <button type="button" class="button" onClick={() => dialog.current?.close()}>
            {t("replay.about.close")}
          </button>
        </div>
        <p class="hint">
          {run.curves.stride === 1
            ? t("replay.about.everySample")
            : t("replay.about.drawn", { stride: run.curves.stride })}
        </p>
        <Value value={run.details} />
      </dialog>
    </header>
  );
}
