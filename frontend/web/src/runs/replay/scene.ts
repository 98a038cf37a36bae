/**
 * The 3D view: viser's own page in a frame, which shares this page's origin, also in a file.
 *
 * Its player has no interface to set a time and plays everything again to go back. The frame
 * holds the scene standing still, and this puts into viser's queue of messages what the live lab
 * would send: for any time, the properties that differ from those shown.
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

const PATIENCE_MS = 30_000;

/** Number of the last key at or before a frame. */
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

/** A property over time; between two frames next to each other it is interpolated. */
class Property {
  #shown = "";

  constructor(
    readonly track: Track,
    private readonly keys: Float32Array,
    private readonly values: Float32Array | null,
  ) {}

  /** The message that brings the property to the frame, or null when it is there already. */
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
    const whole = Math.floor(frame);
    const key = findKey(this.keys, whole);
    if (track.words) return track.words[key] as string | boolean;
    const here = this.#row(key);
    const part = frame - whole;
    const isNext = this.keys[key + 1] === whole + 1;
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

  /** Waits until viser has built the scene; false when it does not come up. */
  async connect(frame: HTMLIFrameElement): Promise<boolean> {
    const names = this.motion.tracks.map((track) => track.name);
    const end = performance.now() + PATIENCE_MS;
    while (performance.now() < end) {
      const viser = (frame.contentWindow as ViserWindow | null)?.__viserMutable;
      if (viser && names.every((name) => name in viser.nodePoseData)) {
        this.#viser = viser;
        return true;
      }
      await new Promise((resolve) => setTimeout(resolve, 50));
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
