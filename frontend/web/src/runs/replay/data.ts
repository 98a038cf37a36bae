/** The run inside the page: JSON, and number arrays in one compressed text. */
import type { ArmSetup } from "../../core/api/arm";
import type { MeasuredWindow, Metrics } from "../../core/api/types";
import type { RunEvent } from "../../core/plots/eventlines";
import type { Measured } from "../list/measured";

export interface Track {
  /** Type of viser's message, name of the node and the property that the message sets. */
  kind: string;
  name: string;
  field: string;
  /** Index of the array of frames at which the property changes; the first is 0. */
  keys: number;
  /** Numbers: `width` of them per key. */
  width?: number;
  values?: number;
  smooth?: boolean;
  /** Strings and booleans, one per key. */
  words?: (string | boolean)[];
}

export interface Motion {
  step_s: number;
  frames: number;
  tracks: Track[];
  theme: Record<string, unknown>;
}

/** A controller of a lane, from one time of the page up to before another. */
export interface LaneSegment {
  number: number;
  name: string;
  line_style: number;
  has_estimate: boolean;
  start_s: number;
  end_s: number;
}

export interface Run {
  title: string;
  period_s: number;
  ticks: number;
  lanes: string[];
  /** Links of an arm, whose lanes are those of its joints; null for a single joint. */
  arm: ArmSetup["links"] | null;
  /** For every lane, in the order of time. */
  segments: LaneSegment[][];
  plant: "simulated" | "emulated" | "bench";
  /** By label. */
  details: Record<string, unknown>;
  events: RunEvent[];
  /** Window of the metrics, in the time of the page. */
  window: Measured & Pick<MeasuredWindow, "kind">;
  /** Metrics of every lane; none if samples are missing. */
  metrics: Metrics[];
  /** One of `stride` samples is drawn, with the peaks between. */
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

/** Read the run from the page; throws if it is damaged. */
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

// Arrays as packed by `svsa_scene/replay_packing.py`.

/** First byte, number of values and, for a curve, the step of which they are multiples. */
type Packed = [start: number, count: number, step?: number];

/** Code of NaN. */
const NONE = -(2 ** 31);

export function unpack(bytes: Uint8Array, [start, count, step]: Packed): Float32Array {
  const words = mergePlanes(bytes, start, count);
  return step === undefined ? new Float32Array(words.buffer) : cumulativeSum(words, step);
}

/** 4-byte words, stored as all first bytes, then all second bytes, and so on. */
function mergePlanes(bytes: Uint8Array, start: number, count: number): Uint32Array<ArrayBuffer> {
  const joined = new Uint8Array(count * 4);
  for (let plane = 0; plane < 4; plane++) {
    const from = start + plane * count;
    for (let index = 0; index < count; index++) {
      joined[index * 4 + plane] = bytes[from + index] as number;
    }
  }
  return new Uint32Array(joined.buffer);
}

/** Decode differences (0, −1, 1, −2 … stored as 0, 1, 2, 3 …) to values. */
function cumulativeSum(changes: Uint32Array, step: number): Float32Array {
  const values = new Float32Array(changes.length);
  let whole = 0;
  changes.forEach((change, index) => {
    whole = (whole + ((change >>> 1) ^ -(change & 1))) | 0;
    values[index] = whole === NONE ? Number.NaN : whole * step;
  });
  return values;
}
