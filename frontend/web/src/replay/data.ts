/** The run inside the page: JSON, and arrays of numbers packed into one compressed text. */
import { type Mark, markOf } from "../layout/plantmark";

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

export interface RunEvent {
  time_s: number;
  label: string;
}

export interface Run {
  title: string;
  period_s: number;
  ticks: number;
  lanes: string[];
  details: Record<string, unknown>;
  events: RunEvent[];
  metrics: Record<string, number | null>[];
  curves: { step_s: number; channels: Record<string, number[]> };
  motion: Motion;
  arrays: { places: [number, number][]; data: string };
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
  const arrays = run.arrays.places.map(([start, count]) => joinPlanes(bytes, start, count));
  return { run, arrays, endS: (run.ticks - 1) * run.period_s };
}

async function inflate(base64: string): Promise<Uint8Array> {
  const packed = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** float32 of which all first bytes stand together, then all second ones, and so on. */
function joinPlanes(bytes: Uint8Array, start: number, count: number): Float32Array {
  const joined = new Uint8Array(count * 4);
  for (let plane = 0; plane < 4; plane++) {
    const from = start + plane * count;
    for (let index = 0; index < count; index++) {
      joined[index * 4 + plane] = bytes[from + index] as number;
    }
  }
  return new Float32Array(joined.buffer);
}
