/** The columns of the table of runs: what they are called, how they sort, what a run has in them. */
import type { ComponentChildren } from "preact";
import type { RunSummary } from "../api/types";
import { text } from "../text/en";
import { formatNumber, toDegrees } from "../units";
import { Marked } from "./marked";
import { formatDuration, formatMoment, formatMomentShort } from "./words";

const words = text.runs;

export interface Column {
  key: string;
  name: string;
  hint?: string;
  /** Said before the value where there is no head of a table. */
  label?: string;
  sort: string;
  /** Whether the first press shows the greatest first. */
  isDownFirst?: boolean;
  isNumber?: boolean;
  /** Whether the name that the run has by itself says it too. */
  isInName?: boolean;
  show: (run: RunSummary) => ComponentChildren;
  hintOf?: (run: RunSummary) => string | undefined;
}

type Measure = "peak_position_error_rad" | "rms_position_error_rad";

const degrees = (run: RunSummary, measure: Measure): string | null =>
  run.metrics === null || run.metrics.length === 0
    ? null
    : run.metrics.map((lane) => `${formatNumber(toDegrees(lane[measure]), 2, 4)}°`).join(" / ");

const setting = (read: (settings: NonNullable<RunSummary["settings"]>) => string) => ({
  show: (run: RunSummary) => run.settings && <Marked>{read(run.settings)}</Marked>,
  hintOf: (run: RunSummary) => (run.settings ? read(run.settings) : undefined),
});

/** "Fig. 4A", "from Fig. 4A", or the motion of a run that is no figure. */
export function figureOf({ settings }: Pick<RunSummary, "settings">): string {
  if (settings === null) return "";
  if (settings.figure === "") return settings.motion;
  return words.figureShown(settings.figure.toUpperCase(), settings.figure_held);
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
    key: "realism",
    name: words.columns.realism,
    hint: words.columns.realismHint,
    sort: "realism",
    isInName: true,
    ...setting(({ realism, own }) => [realism, own && words.own(own)].filter(Boolean).join(", ")),
  },
  {
    key: "peak",
    name: words.columns.peak,
    hint: words.columns.peakHint,
    label: words.peak,
    sort: "peak_position_error_rad",
    isDownFirst: true,
    isNumber: true,
    show: (run) => degrees(run, "peak_position_error_rad"),
    hintOf: (run) => run.settings?.laws,
  },
  {
    key: "rms",
    name: words.columns.rms,
    hint: words.columns.rmsHint,
    label: words.rms,
    sort: "rms_position_error_rad",
    isDownFirst: true,
    isNumber: true,
    show: (run) => degrees(run, "rms_position_error_rad"),
    hintOf: (run) => run.settings?.laws,
  },
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
    show: (run) => <time dateTime={run.created}>{formatMomentShort(run.created)}</time>,
    hintOf: (run) => formatMoment(run.created),
  },
];

export const NAME_SORT = "name";
