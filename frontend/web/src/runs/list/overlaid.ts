/** Several runs on one axis of time: 0 is where the window of their numbers begins, or each run. */
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
import { text } from "../../core/text/en";
import { CHANGES, CHANGES_OF_CONTROLLER, CONTROLLER, LOADS } from "../../core/text/runs";
import { DEGREES_PER_RADIAN } from "../../core/units";
import { shiftToRecord } from "./measured";

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
  position_error_rad: { title: text.overlay.error, unit: text.overlay.degrees },
  stiffness_error_nm_per_rad: { title: text.overlay.stiffness, unit: text.overlay.stiffnessUnit },
};
const POINTS = 4000;

/** What of each run is laid over the others' first, as the API has it for a verdict. */
export type Alignment = VerdictRequest["align"];

/** One lane of one run. */
export interface Overlaid {
  key: string;
  run: string;
  runName: string;
  /** Of the record, and as it is called. */
  laneId: string;
  lane: string;
  /** Who controlled it in the window. */
  measuredLane: string;
  /** The plant of the lane: next to a bench, its twin and other lanes are simulated. */
  plant: RunDetails["plant"];
  isAlone: boolean;
  hasOnset: boolean;
  /** In which the numbers were measured; null where that is not known. */
  window: MeasuredWindow | null;
  /** Its loads and when they came; the same for runs that had the same. */
  loads: string;
  alignment: Alignment;
  /** Where that window begins on the axis, s; 0 where runs are aligned at it. */
  startS: number;
  /** Where it ends on the axis because something was changed then, s; null: never. */
  changedS: number | null;
  /** The session's time where the axis has its 0, s. */
  zeroS: number;
  /** Of who controlled it in the window, in its run. */
  ownLineStyle: number | null;
  lineStyle: LineStyle;
  /** On the axis, s. */
  time: Float64Array;
  values: Record<OverlayChannel, (number | null)[]>;
  /** Of that window; null where samples are no numbers. */
  metrics: Metrics | null;
}

export const nameCurve = ({ isAlone, runName, lane }: Overlaid): string =>
  isAlone ? runName : text.overlay.curve(runName, lane);

function readLane(samples: RunSamples, lane: string): Overlaid["values"] {
  const read = (channel: OverlayChannel) =>
    (samples.lanes[lane]?.[channel] ?? []).map((value) =>
      value === null ? null : value * FACTORS[channel],
    );
  return {
    position_error_rad: read("position_error_rad"),
    stiffness_error_nm_per_rad: read("stiffness_error_nm_per_rad"),
  };
}

/** Every load of a run up to the end of its measured window, in session time, and when that began. */
function keyOfLoads(run: RunDetails): string {
  const { configuration, commands, command_count: count, window } = run;
  if (window === null || count > commands.length) return run.id;
  const given = commands.filter(
    ({ tick, command }) =>
      ["load", "unload"].includes(String(command.kind)) && tick < window.end_tick,
  );
  return JSON.stringify([configuration.loads, given, window.first_tick]);
}

/**
 * At their windows; but where some had a load and others none, as a run that ended before its own,
 * at their starts: else those would stand apart by the time until the load.
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
): Omit<Overlaid, "lineStyle">[] {
  const { id, window } = run;
  const first = run.first_tick * run.period_s;
  const begin = window?.start_s ?? first;
  const zero = alignment === "window" ? begin : first;
  const isCut = window !== null && window.end_tick < run.first_tick + run.ticks;
  const time = Float64Array.from(samples.time_s, (seconds) => seconds - zero);
  return run.lanes.map((lane, index) => ({
    key: `${id}.${lane}`,
    run: id,
    runName: run.title,
    laneId: lane,
    lane: run.lane_names[index] ?? lane,
    measuredLane: window?.lanes[index] ?? lane,
    plant: index === 0 ? run.plant : "simulated",
    ownLineStyle: lineStyleAt(run.segments[index], begin),
    isAlone: run.lanes.length === 1,
    hasOnset: window?.kind === "load",
    window: window && shiftToRecord(window, run),
    loads: keyOfLoads(run),
    alignment,
    startS: begin - zero,
    changedS: isCut ? window.end_s - zero : null,
    zeroS: zero,
    time,
    values: readLane(samples, lane),
    metrics: run.metrics?.[index] ?? null,
  }));
}

/** Every lane of these runs, each in its own line style where no other is drawn in that. */
export async function readOverlaid(runs: readonly string[]): Promise<Overlaid[]> {
  const read = await Promise.all(
    runs.map((id) => Promise.all([readRun(id), readSamples(id, CHANNELS, POINTS)])),
  );
  const alignment = chooseAlignment(read.map(([run]) => run));
  const lanes = read.flatMap(([run, samples]) => overlay(run, samples, alignment));
  const lineStyles = shareLineStyles(lanes.map(({ ownLineStyle }) => ownLineStyle));
  return lanes.map((lane, index) => ({ ...lane, lineStyle: lineStyles[index] as LineStyle }));
}

// Whether metrics of runs may be compared: only if all had the same task.

const words = text.overlay.unlike;

/**
 * What is compared may differ: who controls, with what, and what the server calls a change of it;
 * when a load came is compared in session time, where the server tells it from the record's start.
 */
function listDiffering({ differences }: RunDifference): string[] {
  const found = differences.filter(
    ({ group, name }) =>
      group !== CONTROLLER &&
      group !== LOADS &&
      !(group === CHANGES && CHANGES_OF_CONTROLLER.includes(name)),
  );
  return [...new Set(found.map(({ group, name }) => (group === CHANGES ? name : group)))];
}

const areSame = (keys: readonly unknown[]): boolean => new Set(keys).size <= 1;

/**
 * Why none of these numbers may be called the best; "" where one may.
 *
 * difference: of the settings of the runs; null where it is not known.
 */
export function whyUnlike(curves: readonly Overlaid[], difference: RunDifference | null): string {
  const begins = curves.map(({ window }) => window && `${window.kind} ${window.label}`);
  if (begins.includes(null) || !areSame(begins)) return words.windows;
  if (!areSame(curves.map(({ plant }) => plant))) return words.plants;
  if (areSame(curves.map(({ run }) => run))) return "";
  if (difference === null) return words.unknown;
  const differing = listDiffering(difference);
  if (differing.length > 0) return words.settings(differing);
  return areSame(curves.map(({ loads }) => loads)) ? "" : words.loads;
}

/** Whether the windows are of one length, to a tick: else their rms is not of the same. */
export function areOfOneLength(curves: readonly Overlaid[]): boolean {
  const lengths = curves.map(({ window }) => window && window.end_tick - window.first_tick);
  return !lengths.includes(null) && areSame(lengths);
}
