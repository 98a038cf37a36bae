import { useEffect, useState } from "preact/hooks";
import type { RunSummary } from "../../core/api/types";
import { markOf } from "../../core/state/plant";
import { text } from "../../core/text/en";
import { PlantMark } from "../../core/widgets/plantmark";
import { COLUMNS } from "./columns";
import { chosen, MAX_CHOSEN, putIntoTrash, takeBack, toggleChosen } from "./list";
import { excerpt, Marked, searchedWords } from "./marked";
import { OriginLink } from "./origin";
import { PlaceLink } from "./place";
import { type Glance, keepGlance, Sparkline } from "./sparkline";

const words = text.runs;

/** Null until it is read, and where the run cannot be read. */
function useGlance({ id, ticks }: RunSummary): Glance | null {
  const [glance, setGlance] = useState<Glance | null>(null);
  useEffect(() => {
    let isGone = false;
    const take = (read: Glance | null) => {
      if (!isGone) setGlance(read);
    };
    if (ticks > 0) keepGlance(id, ticks).then(take, () => take(null));
    return () => {
      isGone = true;
    };
  }, [id, ticks]);
  return glance;
}

function State({ run }: { run: RunSummary }) {
  if (run.fault !== null) {
    return (
      <strong class="run-state is-fault" title={run.fault.message}>
        ▲ <Marked>{run.fault.label}</Marked>
      </strong>
    );
  }
  if (run.state === "complete") return null;
  return (
    <strong class={`run-state is-${run.state}`} title={run.message}>
      {run.state === "recording" ? "● " : "▲ "}
      {words.state[run.state]}
    </strong>
  );
}

function Choose({ run }: { run: RunSummary }) {
  const isChosen = chosen.value.includes(run.id);
  return (
    <input
      type="checkbox"
      class="run-choose"
      aria-label={words.choose(run.title)}
      checked={isChosen}
      disabled={run.ticks === 0 || (!isChosen && chosen.value.length >= MAX_CHOSEN)}
      onChange={() => toggleChosen(run.id)}
    />
  );
}

function Remove({ run }: { run: RunSummary }) {
  return (
    <button
      type="button"
      class="button is-icon run-delete"
      aria-label={words.removeThis(run.title)}
      title={words.remove}
      disabled={run.state === "recording"}
      onClick={() => void putIntoTrash(run.id)}
    >
      <svg viewBox="0 0 16 16" aria-hidden="true">
        <path d="M6 1h4l.6 1.2H14v1.5H2V2.2h3.4zM3 5h10l-.7 10H3.7zm3 1.800l.3 6.400h1.200l-.2-6.400zm2.700 0l-.2 6.400h1.200l.3-6.400z" />
      </svg>
    </button>
  );
}

/** What the run is called, and what people wrote to it, as far as there is room. */
function Name({ run }: { run: RunSummary }) {
  const notes = [run.notes, run.message, run.note].filter((note) => note !== "").join(" · ");
  return (
    <th scope="row" class="run-what">
      <div class="run-title">
        {run.deleted === null ? (
          <PlaceLink
            to={{ kind: "run", run: run.id, timeS: 0 }}
            class={run.name === "" ? "is-own" : "is-given"}
            title={run.title}
          >
            <Marked>{run.title}</Marked>
          </PlaceLink>
        ) : (
          <span title={run.title}>
            <Marked>{run.title}</Marked>
          </span>
        )}
        <State run={run} />
        <PlantMark kind={markOf(run.plant)} />
        {run.tags.length > 0 && (
          <span class="run-tags" title={run.tags.join(", ")}>
            {run.tags.map((tag) => (
              <span key={tag} class="tag">
                <Marked>{tag}</Marked>
              </span>
            ))}
          </span>
        )}
        {run.branch_of && <OriginLink origin={run.branch_of} />}
        {notes !== "" && (
          <span class="hint run-notes" title={notes}>
            <Marked>{excerpt(notes, searchedWords.value)}</Marked>
          </span>
        )}
      </div>
    </th>
  );
}

/** A run in the table: what it is called, how its error went, how it was set, how good it was. */
export function RunRow({ run }: { run: RunSummary }) {
  const isDeleted = run.deleted !== null;
  const glance = useGlance(run);
  return (
    <tr class={`run-row ${run.name === "" ? "is-auto" : ""}`}>
      <td class="run-pick">{!isDeleted && <Choose run={run} />}</td>
      <Name run={run} />
      <td class="run-spark">
        <Sparkline glance={glance} />
      </td>
      {COLUMNS.map(({ key, label, isNumber, isInName, show, hintOf }) => {
        const value = show(run);
        const isEmpty = value === null || value === "";
        const look = `${isNumber ? "number" : ""} ${isInName ? "is-in-name" : ""}`;
        return (
          <td
            key={key}
            class={`run-${key} ${look} ${isEmpty ? "is-empty muted" : ""}`}
            title={hintOf?.(run)}
          >
            {label && (
              <span class="muted run-label" aria-hidden="true">
                {label}{" "}
              </span>
            )}
            {isEmpty ? "–" : value}
          </td>
        );
      })}
      <td class="run-act">
        {isDeleted ? (
          <button
            type="button"
            class="button is-small"
            aria-label={words.restoreThis(run.title)}
            onClick={() => void takeBack(run.id)}
          >
            {words.restore}
          </button>
        ) : (
          <Remove run={run} />
        )}
      </td>
    </tr>
  );
}
