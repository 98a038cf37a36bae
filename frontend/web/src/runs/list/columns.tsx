/** The columns of the table of runs: what they are called, how they sort, what a run has in them. */
import type { ComponentChildren } from "preact";
import type { RunSummary } from "../../core/api/types";
import { text } from "../../core/text/en";
import { formatError, formatNumber, toDegrees } from "../../core/units";
import { Marked } from "./marked";
import { describeMeasured, explainSteadyState, shiftToRecord } from "./measured";
import { formatDuration, formatMoment, formatMomentShort } from "./words";

const words = text.runs;
/** Stands between the laws of a lane, one after the other. */
const CHANGED = "→";

export interface Column {
  key: string;
  name: string;
  hint?: string;
  /** Said before the value where there is no head of a table. */
  label?: string;
  /** The server's name for the order by it; left out where there is none. */
  sort?: string;
  /** Whether the first press shows the greatest first. */
  isDownFirst?: boolean;
  isNumber?: boolean;
  /** Whether the automatic name of the run contains it, too. */
  isInName?: boolean;
  show: (run: RunSummary) => ComponentChildren;
  hintOf?: (run: RunSummary) => string | undefined;
}

type Measure =
  | "peak_position_error_rad"
  | "steady_state_position_error_rad"
  | "rms_position_error_rad";

/** Of whom, too, where the laws were not the same throughout. */
function windowOf(run: RunSummary): string | null {
  const isNamed = run.settings?.laws.includes(CHANGED) ?? false;
  return run.window && describeMeasured(shiftToRecord(run.window, run), isNamed);
}

const degreesOf = (run: RunSummary, measure: Measure): string[] =>
  (run.metrics ?? []).map((lane) => formatDegrees(lane[measure]));

/** Lane by lane; where there is no room for all of them, whole values are left out. */
function Degrees({ values }: { values: readonly string[] }) {
  return (
    <>
      {values.map((value, lane) => (
        <span key={lane} class="run-value">
          {lane > 0 && "/ "}
          {value}
        </span>
      ))}
    </>
  );
}

/** Each with who controlled the lane. */
export const describeDegrees = (run: RunSummary, measure: Measure): string | undefined =>
  run.window?.lanes
    .map((name, lane) => `${name} ${degreesOf(run, measure)[lane] ?? formatNumber(null)}`)
    .join(", ");

const formatDegrees = (rad: number | null): string =>
  rad === null ? formatNumber(null) : `${formatError(toDegrees(rad), 2)}°`;

const measureOf = (
  key: string,
  measure: Measure,
  heading: Pick<Column, "name" | "hint" | "label">,
) => ({
  ...heading,
  key,
  sort: measure,
  isDownFirst: true,
  isNumber: true,
  show: (run: RunSummary) =>
    run.metrics?.length ? <Degrees values={degreesOf(run, measure)} /> : null,
  hintOf: (run: RunSummary) => describeDegrees(run, measure),
});

const setting = (read: (settings: NonNullable<RunSummary["settings"]>) => string) => ({
  show: (run: RunSummary) => run.settings && <Marked>{read(run.settings)}</Marked>,
  hintOf: (run: RunSummary) => (run.settings ? read(run.settings) : undefined),
});

/** "Fig. 4A", "Fig. 4A motion", "from Fig. 4A", or the motion of a run of no figure. */
function figureOf({ settings }: Pick<RunSummary, "settings">): string {
  return settings?.figure_name || (settings?.motion ?? "");
}

export const COLUMNS: readonly Column[] = [
  {
    key: "figure",
    name: words.columns.figure,
    sort: "figure",
    isInName: true,
    show: (run) => <Marked>{figureOf(run)}</Marked>,
    hintOf: (run) => run.settings?.motion,
  },
  {
    key: "laws",
    name: words.columns.law,
    sort: "laws",
    isInName: true,
    ...setting(({ laws }) => laws),
  },
  {
    key: "stiffness",
    name: words.columns.stiffness,
    hint: words.columns.stiffnessHint,
    label: words.columns.stiffness,
    sort: "stiffness_nm_per_rad",
    isInName: true,
    ...setting(({ stiffness }) => stiffness),
  },
  {
    key: "load",
    name: words.columns.load,
    sort: "load",
    isInName: true,
    ...setting(({ load }) => load),
  },
  {
    key: "effects",
    name: words.columns.effects,
    hint: words.columns.effectsHint,
    sort: "effects",
    isInName: true,
    ...setting(({ effects, own }) => [effects, own && words.own(own)].filter(Boolean).join(", ")),
  },
  {
    key: "window",
    name: words.columns.window,
    hint: words.columns.windowHint,
    show: windowOf,
    hintOf: (run) => windowOf(run) ?? undefined,
  },
  measureOf("peak", "peak_position_error_rad", {
    name: words.columns.peak,
    hint: words.columns.peakHint,
    label: words.peak,
  }),
  {
    ...measureOf("settled", "steady_state_position_error_rad", {
      name: words.columns.settled,
      hint: words.columns.steadyStateHint,
      label: words.settled,
    }),
    hintOf: (run) =>
      run.window === null
        ? undefined
        : `${describeDegrees(run, "steady_state_position_error_rad")}: ${explainSteadyState(run.window)}`,
  },
  measureOf("rms", "rms_position_error_rad", {
    name: words.columns.rms,
    hint: words.columns.rmsHint,
    label: words.rms,
  }),
  {
    key: "duration",
    name: words.columns.duration,
    sort: "duration_s",
    isDownFirst: true,
    isNumber: true,
    show: (run) => (run.state === "recording" ? null : formatDuration(run.duration_s)),
  },
  {
    key: "created",
    name: words.columns.created,
    sort: "created",
    isDownFirst: true,
    isNumber: true,
    show: (run) => (
      <time class="muted" dateTime={run.created}>
        {formatMomentShort(run.created)}
      </time>
    ),
    hintOf: (run) => formatMoment(run.created),
  },
];

export const NAME_SORT = "name";
