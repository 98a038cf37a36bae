/** Two cursors, each on a sample of what is held; they are there only while the plots stand still. */
import { computed, effect, signal } from "@preact/signals";
import { goLive, held, hold, isHeld } from "./span";

export type CursorName = "a" | "b";
export const CURSOR_NAMES: readonly CursorName[] = ["a", "b"];
const AT_FIRST: Readonly<Record<CursorName, number>> = { a: 0.35, b: 0.65 };

/** Their times, s; null where they are off. */
export const cursors = signal<Readonly<Record<CursorName, number>> | null>(null);
export const areCursorsOn = computed(() => cursors.value !== null);

/** The nearest sample's time. */
function snap(timeS: number): number {
  const ring = held.peek()?.ring;
  return ring === undefined ? timeS : ring.timeAt(ring.nearestTo(timeS));
}

export function moveCursor(name: CursorName, timeS: number): void {
  const times = cursors.peek();
  if (times !== null) cursors.value = { ...times, [name]: snap(timeS) };
}

/** Moves a cursor by so many samples. */
export function stepCursor(name: CursorName, samples: number): void {
  const ring = held.peek()?.ring;
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
  hold();
  const span = held.peek();
  if (span === null || span.ring.length === 0) {
    goLive();
    return;
  }
  const place = (name: CursorName) => snap(span.from + AT_FIRST[name] * (span.to - span.from));
  cursors.value = { a: place("a"), b: place("b") };
}

/** The indices of their samples in what is held; null where they are off. */
export const cursorSamples = computed<readonly [number, number] | null>(() => {
  const ring = held.value?.ring;
  const times = cursors.value;
  if (ring === undefined || times === null) return null;
  return [ring.nearestTo(times.a), ring.nearestTo(times.b)];
});

/** They go when the plots go live. */
export const releaseCursors = (): (() => void) =>
  effect(() => {
    if (!isHeld.value) cursors.value = null;
  });
