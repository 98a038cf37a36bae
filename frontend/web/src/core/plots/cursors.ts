/** Two cursors, each on a stored sample; available only while the plots are frozen. */
import { computed, effect, signal } from "@preact/signals";
import { freeze, frozen, goLive, isFrozen } from "./span";

export type CursorName = "a" | "b";
export const CURSOR_NAMES: readonly CursorName[] = ["a", "b"];
const INITIAL_SHARES: Readonly<Record<CursorName, number>> = { a: 0.35, b: 0.65 };

/** Times of the cursors, s; null while they are off. */
export const cursors = signal<Readonly<Record<CursorName, number>> | null>(null);
export const areCursorsOn = computed(() => cursors.value !== null);

/** Time of the nearest sample. */
function snap(timeS: number): number {
  const ring = frozen.peek()?.ring;
  return ring === undefined ? timeS : ring.timeAt(ring.nearestTo(timeS));
}

export function moveCursor(name: CursorName, timeS: number): void {
  const times = cursors.peek();
  if (times !== null) cursors.value = { ...times, [name]: snap(timeS) };
}

/** Move a cursor by a number of samples. */
export function stepCursor(name: CursorName, samples: number): void {
  const ring = frozen.peek()?.ring;
  const times = cursors.peek();
  if (ring === undefined || times === null) return;
  const index = ring.nearestTo(times[name]) + samples;
  const inside = Math.min(ring.length - 1, Math.max(0, index));
  cursors.value = { ...times, [name]: ring.timeAt(inside) };
}

export function toggleCursors(): void {
  if (cursors.peek() !== null) {
    cursors.value = null;
    return;
  }
  freeze();
  const span = frozen.peek();
  if (span === null || span.ring.length === 0) {
    goLive();
    return;
  }
  const samplePosition = (name: CursorName) =>
    snap(span.from + INITIAL_SHARES[name] * (span.to - span.from));
  cursors.value = { a: samplePosition("a"), b: samplePosition("b") };
}

/** Indices of their samples in the ring; null while they are off. */
export const cursorSamples = computed<readonly [number, number] | null>(() => {
  const ring = frozen.value?.ring;
  const times = cursors.value;
  if (ring === undefined || times === null) return null;
  return [ring.nearestTo(times.a), ring.nearestTo(times.b)];
});

/** Remove the cursors when the plots go live. */
export const releaseCursors = (): (() => void) =>
  effect(() => {
    if (!isFrozen.value) cursors.value = null;
  });
