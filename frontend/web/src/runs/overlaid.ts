/** Several runs on one axis of time, on which 0 is where the window of their numbers begins. */
import { readRun, readSamples } from "../api/runs";
import type { MeasuredWindow, Metrics, RunDetails, RunSamples, StreamedName } from "../api/types";
import type { Ink } from "../plots/definitions";
import { inkOf } from "../plots/inks";
import { text } from "../text/en";
import { DEGREES_PER_RADIAN } from "../units";
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
  /** What it ran on: beside a bench, its twin and others are simulated. */
  plant: RunDetails["plant"];
  isAlone: boolean;
  hasOnset: boolean;
  /** In which the numbers were measured; null where that is not known. */
  window: MeasuredWindow | null;
  /** Its loads and when they came; the same for runs that had the same. */
  loads: string;
  /** When something was changed after that window's beginning, s after it; null: never. */
  changedS: number | null;
  /** The session's time where the axis has its 0, s. */
  zeroS: number;
  ink: Ink;
  /** s after the window's beginning. */
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

async function readLanes(id: string): Promise<Omit<Overlaid, "ink">[]> {
  const [run, samples] = await Promise.all([readRun(id), readSamples(id, CHANNELS, POINTS)]);
  return overlay(run, samples);
}

export function overlay(run: RunDetails, samples: RunSamples): Omit<Overlaid, "ink">[] {
  const { id, window } = run;
  const zero = window?.start_s ?? run.first_tick * run.period_s;
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
    isAlone: run.lanes.length === 1,
    hasOnset: window?.kind === "load",
    window: window && shiftToRecord(window, run),
    loads: keyOfLoads(run),
    changedS: isCut ? window.end_s - zero : null,
    zeroS: zero,
    time,
    values: readLane(samples, lane),
    metrics: run.metrics?.[index] ?? null,
  }));
}

/** Every lane of these runs, each in an ink of its own. */
export async function readOverlaid(runs: readonly string[]): Promise<Overlaid[]> {
  const lanes = (await Promise.all(runs.map(readLanes))).flat();
  return lanes.map((lane, index) => ({ ...lane, ink: inkOf(index) }));
}
