import { useEffect, useState } from "preact/hooks";
import type { RunSummary } from "../api/types";
import { markOf, PlantMark } from "../layout/plantmark";
import { inkOf } from "../plots/inks";
import { Swatch } from "../plots/legend";
import { text } from "../text/en";
import { formatNumber, toDegrees } from "../units";
import { chosen, MOST_CHOSEN, putIntoTrash, takeBack, toggleChosen } from "./list";
import { PlaceLink } from "./placelink";
import { type Glance, keepGlance } from "./spark";
import { Sparkline } from "./sparkline";
import { Tags } from "./tags";
import { formatDuration, formatMoment, nameOf } from "./words";

const words = text.runs;
const degrees = (rad: number | undefined) =>
  formatNumber(rad === undefined ? null : toDegrees(rad), 3, 3);

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

function LaneNumbers({ run, names }: { run: RunSummary; names: readonly string[] }) {
  return (
    <dl class="run-lanes">
      {run.lanes.map((lane, index) => (
        <div key={lane}>
          <dt>
            <Swatch look={inkOf(index + 1)} />
            {names[index] ?? lane}
          </dt>
          <dd>
            <span class="unit">{words.rms}</span>{" "}
            {degrees(run.metrics?.[index]?.rms_position_error_rad)}°
          </dd>
          <dd>
            <span class="unit">{words.peak}</span>{" "}
            {degrees(run.metrics?.[index]?.peak_position_error_rad)}°
          </dd>
        </div>
      ))}
    </dl>
  );
}

function State({ run }: { run: RunSummary }) {
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
      aria-label={words.choose(nameOf(run))}
      checked={isChosen}
      disabled={run.ticks === 0 || (!isChosen && chosen.value.length >= MOST_CHOSEN)}
      onChange={() => toggleChosen(run.id)}
    />
  );
}

/** A run in the list: how its error went, what it is called, how good it was. */
export function RunRow({ run }: { run: RunSummary }) {
  const name = nameOf(run);
  const isDeleted = run.deleted !== null;
  const glance = useGlance(run);
  return (
    <li class="run-row">
      {!isDeleted && <Choose run={run} />}
      <Sparkline glance={glance} />
      <div class="run-what">
        <h3>
          {isDeleted ? (
            name
          ) : (
            <PlaceLink to={{ kind: "run", run: run.id, timeS: 0 }}>{name}</PlaceLink>
          )}
          <State run={run} />
          <PlantMark kind={markOf(run.plant)} />
        </h3>
        <p class="run-when">
          {formatMoment(run.created)} · {formatDuration(run.duration_s)}
          {run.notes !== "" && <span class="run-notes"> · {run.notes}</span>}
          {run.message !== "" && <span class="run-notes"> · {run.message}</span>}
        </p>
        {!isDeleted && <Tags run={run} />}
      </div>
      <LaneNumbers run={run} names={glance?.lanes ?? []} />
      {isDeleted ? (
        <button
          type="button"
          class="button"
          aria-label={words.restoreThis(name)}
          onClick={() => void takeBack(run.id)}
        >
          {words.restore}
        </button>
      ) : (
        <button
          type="button"
          class="button is-icon run-delete"
          aria-label={words.removeThis(name)}
          title={words.remove}
          disabled={run.state === "recording"}
          onClick={() => void putIntoTrash(run.id)}
        >
          <svg viewBox="0 0 16 16" aria-hidden="true">
            <path d="M6 1h4l.6 1.2H14v1.5H2V2.2h3.4zM3 5h10l-.7 10H3.7zm3 1.800l.3 6.400h1.200l-.2-6.400zm2.700 0l-.2 6.400h1.200l.3-6.400z" />
          </svg>
        </button>
      )}
    </li>
  );
}
