/** Several runs on one axis of time, on which 0 is the load's onset. */
import { readMetrics, readRun, readSamples } from "../api/runs";
import type { Metrics, RunSamples } from "../api/types";
import type { Ink } from "../plots/definitions";
import { inkOf } from "../plots/inks";
import { text } from "../text/en";
import { DEGREES_PER_RADIAN } from "../units";
import { findLoad } from "./onset";

export const CHANNELS = ["position_error_rad", "stiffness_error_nm_per_rad"] as const;
export type OverlayChannel = (typeof CHANNELS)[number];
const FACTORS: Record<OverlayChannel, number> = {
  position_error_rad: DEGREES_PER_RADIAN,
  stiffness_error_nm_per_rad: 1,
};
const POINTS = 4000;

/** One lane of one run. */
export interface Overlaid {
  key: string;
  run: string;
  runName: string;
  lane: string;
  isAlone: boolean;
  hasOnset: boolean;
  /** When something was changed after the load, s after it: the numbers are of before. */
  changedS: number | null;
  ink: Ink;
  /** s after the onset. */
  time: Float64Array;
  values: Record<OverlayChannel, (number | null)[]>;
  /** From the onset to the next change or the end; null where samples are no numbers. */
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

async function readLanes(id: string): Promise<Omit<Overlaid, "ink">[]> {
  const run = await readRun(id);
  const load = findLoad(run);
  const zero = load?.start_s ?? run.first_tick * run.period_s;
  const [samples, metrics] = await Promise.all([
    readSamples(id, CHANNELS, POINTS),
    readMetrics(id, zero, load?.end_s ?? null),
  ]);
  const time = Float64Array.from(samples.time_s, (seconds) => seconds - zero);
  return run.lanes.map((lane, index) => ({
    key: `${id}.${lane}`,
    run: id,
    runName: run.title,
    lane: run.lane_names[index] ?? lane,
    isAlone: run.lanes.length === 1,
    hasOnset: load !== null,
    changedS: load?.end_s == null ? null : load.end_s - zero,
    time,
    values: readLane(samples, lane),
    metrics: metrics.lanes[lane] ?? null,
  }));
}

/** Every lane of these runs, each in an ink of its own. */
export async function readOverlaid(runs: readonly string[]): Promise<Overlaid[]> {
  const lanes = (await Promise.all(runs.map(readLanes))).flat();
  return lanes.map((lane, index) => ({ ...lane, ink: inkOf(index) }));
}
