/** The columns of the table of runs: labels, sorting, cells. */
import type { ComponentChildren } from "preact";
import type { RunSummary } from "../../core/api/types";
import { t } from "../../core/text/t";
import { formatError, formatNumber, toDegrees } from "../../core/units";
import { Highlighted } from "./highlight";
import { describeMeasured, explainSteadyState, shiftToRecordTime } from "./measured";
import { formatDuration, formatMoment, formatMomentShort } from "./words";

/** Separates successive laws of a lane. */
const CHANGED = "→";

export interface Column {
  key: string;
  name: string;
  hint?: string;
  /** Label before the value if the table has no header. */
  label?: string;
  /** The server's name of the sort order; left out if there is none. */
  sort?: string;
  /** Whether the first click sorts in descending order. */
  isDownFirst?: boolean;
  isNumber?: boolean;
  /** In a table with headers. */
  width: string;
  /** Whether the automatic name of the run contains it, too. */
  isInName?: boolean;
  show: (run: RunSummary) => ComponentChildren;
  hintOf?: (run: RunSummary) => string | undefined;
}

type Measure =
  | "peak_position_error_rad"
  | "steady_state_position_error_rad"
  | "rms_position_error_rad";

/** With the law in control, if the laws changed during the run. */
function windowOf(run: RunSummary): string | null {
  const isNamed = run.settings?.laws.includes(CHANGED) ?? false;
  return run.window && describeMeasured(shiftToRecordTime(run.window, run), isNamed);
}

const degreesOf = (run: RunSummary, measure: Measure): string[] =>
  (run.metrics ?? []).map((lane) => formatDegrees(lane[measure]));

/** One value per lane; if they do not fit, whole values are left out. */
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

/** Each with the law that controlled the lane. */
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
  width: "108px",
  sort: measure,
  isDownFirst: true,
  isNumber: true,
  show: (run: RunSummary) =>
    run.metrics?.length ? <Degrees values={degreesOf(run, measure)} /> : null,
  hintOf: (run: RunSummary) => describeDegrees(run, measure),
});

const setting = (read: (settings: NonNullable<RunSummary["settings"]>) => string) => ({
  show: (run: RunSummary) => run.settings && <Highlighted>{read(run.settings)}</Highlighted>,
  hintOf: (run: RunSummary) => (run.settings ? read(run.settings) : undefined),
});

/** "Fig. 4A", "Fig. 4A motion", "from Fig. 4A", or the motion of a run without a figure. */
function figureOf({ settings }: Pick<RunSummary, "settings">): string {
  return settings?.figure_name || (settings?.motion ?? "");
}

export const COLUMNS: readonly Column[] = [
  {
    key: "figure",
    width: "clamp(78px, 12vw - 75px, 96px)",
    name: t("runs.columns.figure"),
    sort: "figure",
    isInName: true,
    show: (run) => <Highlighted>{figureOf(run)}</Highlighted>,
    hintOf: (run) => run.settings?.motion,
  },
  {
    key: "laws",
    width: "118px",
    name: t("runs.columns.law"),
    sort: "laws",
    isInName: true,
    ...setting(({ laws }) => laws),
  },
  {
    key: "stiffness",
    width: "clamp(62px, 12vw - 92px, 78px)",
    name: t("runs.columns.stiffness"),
    hint: t("runs.columns.stiffnessHint"),
    label: t("runs.columns.stiffness"),
    sort: "stiffness_nm_per_rad",
    isInName: true,
    ...setting(({ stiffness }) => stiffness),
  },
  {
    key: "load",
    width: "clamp(82px, 20vw - 174px, 112px)",
    name: t("runs.columns.load"),
    sort: "load",
    isInName: true,
    ...setting(({ load }) => load),
  },
  {
    key: "effects",
    width: "84px",
    name: t("runs.columns.effects"),
    hint: t("runs.columns.effectsHint"),
    sort: "effects",
    isInName: true,
    ...setting(({ effects, own }) =>
      [effects, own && t("runs.own", { what: own })].filter(Boolean).join(", "),
    ),
  },
  {
    key: "window",
    width: "clamp(178px, 12vw + 24px, 194px)",
    name: t("runs.columns.window"),
    hint: t("runs.columns.windowHint"),
    show: windowOf,
    hintOf: (run) => windowOf(run) ?? undefined,
  },
  measureOf("peak", "peak_position_error_rad", {
    name: t("runs.columns.peak"),
    hint: t("runs.columns.peakHint"),
    label: t("runs.peak"),
  }),
  {
    ...measureOf("settled", "steady_state_position_error_rad", {
      name: t("runs.columns.settled"),
      hint: t("runs.columns.steadyStateHint"),
      label: t("runs.settled"),
    }),
    // Both values of two lanes.
    width: "clamp(108px, 20vw - 148px, 140px)",
    hintOf: (run) =>
      run.window === null
        ? undefined
        : `${describeDegrees(run, "steady_state_position_error_rad")}: ${explainSteadyState(run.window)}`,
  },
  measureOf("rms", "rms_position_error_rad", {
    name: t("runs.columns.rms"),
    hint: t("runs.columns.rmsHint"),
    label: t("runs.rms"),
  }),
  {
    key: "duration",
    width: "74px",
    name: t("runs.columns.duration"),
    sort: "duration_s",
    isDownFirst: true,
    isNumber: true,
    show: (run) => (run.state === "recording" ? null : formatDuration(run.duration_s)),
  },
  {
    key: "created",
    width: "112px",
    name: t("runs.columns.created"),
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
