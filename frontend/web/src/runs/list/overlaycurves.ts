/** Several runs on one time axis: 0 is the start of the measured window, or of each run. */
import { readRun, readSamples } from "../../core/api/runs";
import type {
  MeasuredWindow,
  Metrics,
  RunDetails,
  RunDifference,
  RunSamples,
  StreamedName,
  VerdictRequest,
} from "../../core/api/types";
import type { LineStyle } from "../../core/plots/definitions";
import { lineStyleAt, shareLineStyles } from "../../core/plots/linestyles";
import { CHANGES, CHANGES_OF_CONTROLLER, CONTROLLER, LOADS } from "../../core/text/runs";
import { t } from "../../core/text/t";
import { DEGREES_PER_RADIAN } from "../../core/units";
import { shiftToRecordTime } from "./measured";

export const CHANNELS = [
  "position_error_rad",
  "stiffness_error_nm_per_rad",
] as const satisfies readonly StreamedName[];
export type OverlayChannel = (typeof CHANNELS)[number];
export const FACTORS: Record<OverlayChannel, number> = {
  position_error_rad: DEGREES_PER_RADIAN,
  stiffness_error_nm_per_rad: 1,
};
export const TITLES: Record<OverlayChannel, { title: string; unit: string }> = {
  position_error_rad: { title: t("overlay.error"), unit: t("overlay.degrees") },
  stiffness_error_nm_per_rad: { title: t("overlay.stiffness"), unit: t("overlay.stiffnessUnit") },
};
const POINTS = 4000;

/** Alignment of the runs, as in the API of a verdict. */
export type Alignment = VerdictRequest["align"];

/** One lane of one run. */
export interface OverlayCurve {
  key: string;
  run: string;
  runName: string;
  /** Id of the record, and its name. */
  laneId: string;
  lane: string;
  /** Its controller in the window. */
  measuredLane: string;
  /** The plant of the lane: on a bench, the twin and other lanes are simulated. */
  plant: RunDetails["plant"];
  isAlone: boolean;
  startsWithLoad: boolean;
  /** Window in which the metrics were measured; null if unknown. */
  window: MeasuredWindow | null;
  /** Its loads with their onsets; equal for runs with the same loads. */
  loads: string;
  alignment: Alignment;
  /** Start of that window on the axis, s; 0 if runs are aligned at it. */
  startS: number;
  /** End of that window on the axis because of a change, s; null: never. */
  changedS: number | null;
  /** Session time at the axis' 0, s. */
  zeroS: number;
  /** Controller number of the window, in its run. */
  ownLineStyle: number | null;
  lineStyle: LineStyle;
  /** On the axis, s. */
  time: Float64Array;
  values: Record<OverlayChannel, (number | null)[]>;
  /** Metrics of that window; null if samples are missing. */
  metrics: Metrics | null;
}

export const nameCurve = ({ isAlone, runName, lane }: OverlayCurve): string =>
  isAlone ? runName : t("overlay.curve", { run: runName, lane });

/** Start of the window of the metrics, if it is another event than a load. */
export const nameWindow = ({ window }: Pick<OverlayCurve, "window">): string =>
  window?.label ? t("overlay.fromChange", { change: window.label }) : t("overlay.fromStart");

function readLane(samples: RunSamples, lane: string): OverlayCurve["values"] {
  const read = (channel: OverlayChannel) =>
    (samples.lanes[lane]?.[channel] ?? []).map((value) =>
      value === null ? null : value * FACTORS[channel],
    );
  return {
    position_error_rad: read("position_error_rad"),
    stiffness_error_nm_per_rad: read("stiffness_error_nm_per_rad"),
  };
}

/**
 * Every load of a run up to the end of its measured window, in session time, and the start of the
 * window.
 */
function loadsKey(run: RunDetails): string {
  const { configuration, commands, command_count: count, window } = run;
  if (window === null || count > commands.length) return run.id;
  const loadCommands = commands.filter(
    ({ tick, command }) =>
      ["load", "unload"].includes(String(command.kind)) && tick < window.end_tick,
  );
  return JSON.stringify([configuration.loads, loadCommands, window.first_tick]);
}

/**
 * Align at the windows; but if some runs had a load and others none, as a run that ended early, at
 * their starts: otherwise they would be shifted by the time until the load.
 */
export function chooseAlignment(runs: readonly RunDetails[]): Alignment {
  const loaded = runs.filter(({ window }) => window?.kind === "load").length;
  const isMixed = loaded > 0 && loaded < runs.length;
  return isMixed && runs.every(({ first_tick: first }) => first === 0) ? "start" : "window";
}

export function overlay(
  run: RunDetails,
  samples: RunSamples,
  alignment: Alignment = "window",
): Omit<OverlayCurve, "lineStyle">[] {
  const { id, window } = run;
  const first = run.first_tick * run.period_s;
  const windowStart = window?.start_s ?? first;
  const zero = alignment === "window" ? windowStart : first;
  const isChanged = window !== null && window.end_tick < run.first_tick + run.ticks;
  const time = Float64Array.from(samples.time_s, (seconds) => seconds - zero);
  return run.lanes.map((lane, index) => ({
    key: `${id}.${lane}`,
    run: id,
    runName: run.title,
    laneId: lane,
    lane: run.lane_names[index] ?? lane,
    measuredLane: window?.lanes[index] ?? lane,
    plant: index === 0 ? run.plant : "simulated",
    ownLineStyle: lineStyleAt(run.segments[index], windowStart),
    isAlone: run.lanes.length === 1,
    startsWithLoad: window?.kind === "load",
    window: window && shiftToRecordTime(window, run),
    loads: loadsKey(run),
    alignment,
    startS: windowStart - zero,
    changedS: isChanged ? window.end_s - zero : null,
    zeroS: zero,
    time,
    values: readLane(samples, lane),
    metrics: run.metrics?.[index] ?? null,
  }));
}

/** Every lane of these runs, each with its own line style if it is free. */
export async function readCurves(runs: readonly string[]): Promise<OverlayCurve[]> {
  const read = await Promise.all(
    runs.map((id) => Promise.all([readRun(id), readSamples(id, CHANNELS, POINTS)])),
  );
  const alignment = chooseAlignment(read.map(([run]) => run));
  const lanes = read.flatMap(([run, samples]) => overlay(run, samples, alignment));
  const lineStyles = shareLineStyles(lanes.map(({ ownLineStyle }) => ownLineStyle));
  return lanes.map((lane, index) => ({ ...lane, lineStyle: lineStyles[index] as LineStyle }));
}

// Metrics of runs may be compared only if all had the same task.

/**
 * Differences that a comparison permits: controllers and their settings, and the server's changes
 * of them; the onset of a load is compared in session time, while the server uses the record's
 * start.
 */
function listDiffering({ differences }: RunDifference): string[] {
  const taskDifferences = differences.filter(
    ({ group, name }) =>
      group !== CONTROLLER &&
      group !== LOADS &&
      !(group === CHANGES && CHANGES_OF_CONTROLLER.includes(name)),
  );
  return [...new Set(taskDifferences.map(({ group, name }) => (group === CHANGES ? name : group)))];
}

const areSame = (keys: readonly unknown[]): boolean => new Set(keys).size <= 1;

/**
 * Why none of these values may be marked as the best; "" if one may.
 *
 * difference: of the settings of the runs; null if unknown.
 */
export function explainDifference(
  curves: readonly OverlayCurve[],
  difference: RunDifference | null,
): string {
  const windowNames = curves.map(({ window }) => window && `${window.kind} ${window.label}`);
  if (windowNames.includes(null) || !areSame(windowNames)) return t("overlay.unlike.windows");
  if (!areSame(curves.map(({ plant }) => plant))) return t("overlay.unlike.plants");
  if (areSame(curves.map(({ run }) => run))) return "";
  if (difference === null) return t("overlay.unlike.unknown");
  const differing = listDiffering(difference);
  if (differing.length > 0) return t("overlay.unlike.settings", { groups: differing.join(", ") });
  return areSame(curves.map(({ loads }) => loads)) ? "" : t("overlay.unlike.loads");
}

/**
 * Whether the windows have the same length, within a tick: otherwise their rms values are not
 * comparable.
 */
export function haveEqualLength(curves: readonly OverlayCurve[]): boolean {
  const lengths = curves.map(({ window }) => window && window.end_tick - window.first_tick);
  return !lengths.includes(null) && areSame(lengths);
}
