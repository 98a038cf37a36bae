/**
 * The 3D view: viser's page in a frame of the same origin, also in a file.
 *
 * viser's player has no interface to set a time, and replays everything to go back. Therefore the
 * frame contains the static scene, and this module puts the messages of the live lab into viser's
 * queue: for any time, the properties that differ from those shown.
 */
import type { Motion, Track } from "./data";

interface ViserState {
  messageQueue: Record<string, unknown>[];
  nodePoseData: Record<string, unknown>;
  requestRender(): void;
}

interface ViserWindow extends Window {
  __viserMutable?: ViserState;
}

type Value = string | boolean | number[];

const WAIT_MS = 50;

/** Index of the last key at or before a frame. */
function findKey(keys: Float32Array, frame: number): number {
  let low = 0;
  let high = keys.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if ((keys[middle] as number) <= frame) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** A property over time; interpolated between two adjacent frames. */
class Property {
  #shown = "";

  constructor(
    readonly track: Track,
    private readonly keys: Float32Array,
    private readonly values: Float32Array | null,
  ) {}

  /** The message that sets the property for the frame, or null if it is already set. */
  messageFor(frame: number): Record<string, unknown> | null {
    const value = this.#read(frame);
    const shown = String(value);
    if (shown === this.#shown) return null;
    this.#shown = shown;
    const { kind, name, field } = this.track;
    const content = kind === "SceneNodeUpdateMessage" ? { updates: { [field]: value } } : null;
    return { type: kind, name, owner: "", ...(content ?? { [field]: value }) };
  }

  #read(frame: number): Value {
    const { track } = this;
    const lower = Math.floor(frame);
    const key = findKey(this.keys, lower);
    if (track.words) return track.words[key] as string | boolean;
    const here = this.#row(key);
    const part = frame - lower;
    const isNext = this.keys[key + 1] === lower + 1;
    if (!track.smooth || !isNext || part === 0) return here;
    const next = this.#row(key + 1);
    const mixed = here.map((value, index) => value + part * ((next[index] as number) - value));
    return track.field === "wxyz" ? normalize(mixed) : mixed;
  }

  #row(key: number): number[] {
    const width = this.track.width ?? 1;
    return Array.from(this.values?.subarray(key * width, (key + 1) * width) ?? []);
  }
}

function normalize(vector: number[]): number[] {
  const length = Math.hypot(...vector);
  return vector.map((value) => value / length);
}

export class Scene {
  readonly #properties: Property[];
  #viser: ViserState | null = null;

  constructor(
    private readonly motion: Motion,
    arrays: readonly Float32Array[],
  ) {
    this.#properties = motion.tracks.map(
      (track) =>
        new Property(
          track,
          arrays[track.keys] as Float32Array,
          track.values === undefined ? null : (arrays[track.values] as Float32Array),
        ),
    );
  }

  /** Wait until viser has built the scene; false if its frame is removed before. */
  async connect(frame: HTMLIFrameElement): Promise<boolean> {
    const names = this.motion.tracks.map((track) => track.name);
    while (frame.isConnected) {
      const viser = (frame.contentWindow as ViserWindow | null)?.__viserMutable;
      if (viser && names.every((name) => name in viser.nodePoseData)) {
        this.#viser = viser;
        return true;
      }
      await new Promise((resolve) => setTimeout(resolve, WAIT_MS));
    }
    return false;
  }

  show(timeS: number): void {
    if (this.#viser === null) return;
    const frame = Math.min(timeS / this.motion.step_s, this.motion.frames - 1);
    for (const property of this.#properties) {
      const message = property.messageFor(frame);
      if (message) this.#viser.messageQueue.push(message);
    }
    this.#viser.requestRender();
  }

  setTheme(isDark: boolean): void {
    if (this.#viser === null) return;
    this.#viser.messageQueue.push({ ...this.motion.theme, dark_mode: isDark });
    this.#viser.requestRender();
  }
}
