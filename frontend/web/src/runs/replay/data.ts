/** The run inside the page: JSON, and arrays of numbers packed into one compressed text. */
import type { MeasuredWindow, Metrics } from "../../core/api/types";
import type { RunEvent } from "../../core/plots/eventlines";
import { type Mark, markOf } from "../../core/state/plant";
import type { Measured } from "../list/measured";

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
  /** Of every lane, in the order of time. */
  segments: LaneSegment[][];
  details: Record<string, unknown>;
  events: RunEvent[];
  /** In which the metrics were measured, in the time of the page. */
  window: Measured & Pick<MeasuredWindow, "kind">;
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

/** The label next to the picture; empty for a simulation. */
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

// Arrays as `svsa_scene/replay_packing.py` packs them.

/** First byte, number of values and, of a curve, the step of which they are multiples. */
type Packed = [start: number, count: number, step?: number];

/** No number. */
const NONE = -(2 ** 31);

export function unpack(bytes: Uint8Array, [start, count, step]: Packed): Float32Array {
  const words = joinPlanes(bytes, start, count);
  return step === undefined ? new Float32Array(words.buffer) : addUp(words, step);
}

/** Words of 4 bytes of which all first bytes stand together, then all second ones, and so on. */
function joinPlanes(bytes: Uint8Array, start: number, count: number): Uint32Array<ArrayBuffer> {
  const joined = new Uint8Array(count * 4);
  for (let plane = 0; plane < 4; plane++) {
    const from = start + plane * count;
    for (let index = 0; index < count; index++) {
      joined[index * 4 + plane] = bytes[from + index] as number;
    }
  }
  return new Uint32Array(joined.buffer);
}

/** From differences, 0, −1, 1, −2 … written as 0, 1, 2, 3 …, to values. */
function addUp(changes: Uint32Array, step: number): Float32Array {
  const values = new Float32Array(changes.length);
  let whole = 0;
  changes.forEach((change, index) => {
    whole = (whole + ((change >>> 1) ^ -(change & 1))) | 0;
    values[index] = whole === NONE ? Number.NaN : whole * step;
  });
  return values;
}
