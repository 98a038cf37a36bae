/** The run inside the page: JSON, and arrays of numbers packed into one compressed text. */
import type { Metrics } from "../../core/api/types";
import type { RunEvent } from "../../core/plots/eventlines";
import { type Mark, markOf } from "../../core/state/plant";
import type { Measured } from "../list/measured";
import { type Packed, unpack } from "./packing";

export interface Track {
  /** Type of viser's message, name of the node and the property that the message sets. */
  kind: string;
  name: string;
  field: string;
  /** Number of the array of frames at which the property changes; the first is 0. */
  keys: number;
  /** Numbers: `width` of them a key. */
  width?: number;
  values?: number;
  smooth?: boolean;
  /** Words and switches, one a key. */
  words?: (string | boolean)[];
}

export interface Motion {
  step_s: number;
  frames: number;
  tracks: Track[];
  theme: Record<string, unknown>;
}

/** Who controlled a lane, from a time of the page on up to before another. */
export interface LaneStretch {
  number: number;
  name: string;
  line_style: number;
  start_s: number;
  end_s: number;
}

export interface Run {
  title: string;
  period_s: number;
  ticks: number;
  lanes: string[];
  /** Of every lane, in the order of time. */
  stretches: LaneStretch[][];
  details: Record<string, unknown>;
  events: RunEvent[];
  /** In which the metrics were measured, in the time of the page. */
  window: Measured;
  /** Of every lane; none where samples are no numbers. */
  metrics: Metrics[];
  /** Of `stride` samples one is drawn, with the peaks between. */
  curves: { step_s: number; stride: number; channels: Record<string, number[]> };
  motion: Motion;
  arrays: { places: Packed[]; data: string };
  scene: string;
}

export interface Recording {
  run: Run;
  arrays: Float32Array[];
  /** Time of the last sample, s. */
  endS: number;
}

/** What stands beside the picture; nothing for a simulation. */
export function findMark({ details: { plant } }: Run): Mark | null {
  return plant === "emulated" || plant === "bench" ? markOf(plant) : null;
}

/** Reads the run out of the page; throws where it is damaged. */
export async function readRecording(): Promise<Recording> {
  const run = JSON.parse(document.getElementById("run")?.textContent ?? "") as Run;
  const bytes = await inflate(run.arrays.data);
  const arrays = run.arrays.places.map((place) => unpack(bytes, place));
  return { run, arrays, endS: (run.ticks - 1) * run.period_s };
}

async function inflate(base64: string): Promise<Uint8Array> {
  const packed = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
