import { useEffect, useState } from "preact/hooks";
import type { RunSummary } from "../../core/api/types";
import { plantKindOfRun } from "../../core/state/plant";
import { t } from "../../core/text/t";
import { PlantMark } from "../../core/widgets/plantmark";
import { COLUMNS } from "./columns";
import { excerpt, Highlighted, searchedWords } from "./highlight";
import { MAX_SELECTED, moveToTrash, restoreFromTrash, selectedRuns, toggleSelected } from "./list";
import { OriginLink } from "./origin";
import { PlaceLink } from "./place";
import { type RunOverview, readOverview, Sparkline } from "./sparkline";

/** Null until it is read, and if the run cannot be read. */
function useOverview({ id, ticks }: RunSummary): RunOverview | null {
  const [overview, setOverview] = useState<RunOverview | null>(null);
  useEffect(() => {
    let isMissing = false;
    const take = (read: RunOverview | null) => {
      if (!isMissing) setOverview(read);
    };
    if (ticks > 0) readOverview(id, ticks).then(take, () => take(null));
    return () => {
      isMissing = true;
    };
  }, [id, ticks]);
  return overview;
}

function State({ run }: { run: RunSummary }) {
  if (run.fault !== null) {
    return (
      <strong class="bad small clip" title={run.fault.message}>
        ▲ <Highlighted>{run.fault.label}</Highlighted>
      </strong>
    );
  }
  if (run.state === "complete") return null;
  return (
    <strong class={"bad small"} title={run.message}>
      {run.state === "recording" ? "● " : "▲ "}
      {t(`runs.state.${run.state}`)}
    </strong>
  );
}

function Choose({ run }: { run: RunSummary }) {
  const isChosen = selectedRuns.value.includes(run.id);
  return (
    <input
      type="checkbox"
      aria-label={t("runs.choose", { name: run.title })}
      checked={isChosen}
      disabled={run.ticks === 0 || (!isChosen && selectedRuns.value.length >= MAX_SELECTED)}
      onChange={() => toggleSelected(run.id)}
    />
  );
}

function Remove({ run }: { run: RunSummary }) {
  return (
    <button
      type="button"
      class="quiet muted"
      aria-label={t("runs.removeThis", { name: run.title })}
      title={t("runs.remove")}
      disabled={run.state === "recording"}
      onClick={() => void moveToTrash(run.id)}
    >
      <svg viewBox="0 0 16 16" aria-hidden="true">
        <path d="M6 1h4l.6 1.2H14v1.5H2V2.2h3.4zM3 5h10l-.7 10H3.7zm3 1.800l.3 6.400h1.200l-.2-6.400zm2.700 0l-.2 6.400h1.200l.3-6.400z" />
      </svg>
    </button>
  );
}

/** The name of the run, and its tags and notes if they fit. */
function Name({ run }: { run: RunSummary }) {
  const notes = [run.notes, run.message, run.note].filter((note) => note !== "").join(" · ");
  return (
    <th scope="row" class="run-what">
      <div class="line run-title">
        {run.deleted === null ? (
          <PlaceLink
            to={{ kind: "run", run: run.id, timeS: 0 }}
            class={run.name === "" ? "clip" : "clip strong"}
            title={run.title}
          >
            <Highlighted>{run.title}</Highlighted>
          </PlaceLink>
        ) : (
          <span class="clip" title={run.title}>
            <Highlighted>{run.title}</Highlighted>
          </span>
        )}
        <State run={run} />
        <PlantMark kind={plantKindOfRun(run.plant)} />
        {run.tags.length > 0 && (
          <span class="clip run-tags" title={run.tags.join(", ")}>
            {run.tags.map((tag) => (
              <span key={tag} class="tag">
                <Highlighted>{tag}</Highlighted>
              </span>
            ))}
          </span>
        )}
        {run.branch_of && <OriginLink origin={run.branch_of} />}
        {notes !== "" && (
          <span class="hint clip grow" title={notes}>
            <Highlighted>{excerpt(notes, searchedWords.value)}</Highlighted>
          </span>
        )}
      </div>
    </th>
  );
}

/** A run in the table: name, error curve, settings, metrics. */
export function RunRow({ run }: { run: RunSummary }) {
  const isDeleted = run.deleted !== null;
  const overview = useOverview(run);
  return (
    <tr class={run.name === "" ? "is-auto" : ""}>
      <td class="run-pick">{!isDeleted && <Choose run={run} />}</td>
      <Name run={run} />
      <td class="run-spark">
        <Sparkline overview={overview} />
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
            aria-label={t("runs.restoreThis", { name: run.title })}
            onClick={() => void restoreFromTrash(run.id)}
          >
            {t("runs.restore")}
          </button>
        ) : (
          <Remove run={run} />
        )}
      </td>
    </tr>
  );
}
