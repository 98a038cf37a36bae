/** Several runs on one axis of time, on which 0 is the load's onset. */
import { readMetrics, readRun, readSamples } from "../api/runs";
import type { Metrics, RunSamples } from "../api/types";
import type { Ink, PlotColour } from "../plots/definitions";
import { text } from "../text/en";
import { DEGREES_PER_RADIAN } from "../units";
import { findOnset } from "./onset";

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
  ink: Ink;
  /** s after the onset. */
  time: Float64Array;
  values: Record<OverlayChannel, (number | null)[]>;
  /** From the onset to the end; null where samples are no numbers. */
  metrics: Metrics | null;
}

export const nameCurve = ({ isAlone, runName, lane }: Overlaid): string =>
  isAlone ? runName : text.overlay.curve(runName, lane);

const COLOURS: readonly PlotColour[] = ["blue", "vermilion", "green", "purple", "orange"];
const DASHES = [[], [9, 4], [3, 3], [10, 3, 2, 3]] as const;

/** Twenty inks, of which no two share both colour and dash, and neighbours share neither. */
export const overlayInk = (index: number): Ink => ({
  colour: COLOURS[index % COLOURS.length] as PlotColour,
  dash: DASHES[index % DASHES.length] as readonly number[],
  width: 2,
});

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
  const onset = findOnset(run);
  const zero = onset ?? run.first_tick * run.period_s;
  const [samples, metrics] = await Promise.all([
    readSamples(id, CHANNELS, POINTS),
    readMetrics(id, zero),
  ]);
  const time = Float64Array.from(samples.time_s, (seconds) => seconds - zero);
  return run.lanes.map((lane, index) => ({
    key: `${id}.${lane}`,
    run: id,
    runName: run.title,
    lane: run.lane_names[index] ?? lane,
    isAlone: run.lanes.length === 1,
    hasOnset: onset !== null,
    time,
    values: readLane(samples, lane),
    metrics: metrics.lanes[lane] ?? null,
  }));
}

/** Every lane of these runs, each in an ink of its own. */
export async function readOverlaid(runs: readonly string[]): Promise<Overlaid[]> {
  const lanes = (await Promise.all(runs.map(readLanes))).flat();
  return lanes.map((lane, index) => ({ ...lane, ink: overlayInk(index) }));
}
