/** The time under the pointer, the same in all plots. */
import { signal } from "@preact/signals";
import { shownRing, shownSpan } from "./span";

/** Where the pointer is on the axis, 0 to 1; null where it is not over a plot. */
export const hoverShare = signal<number | null>(null);

/** The time under the pointer, s; null where it is not over a plot. */
export function hoverTime(): number | null {
  const share = hoverShare.peek();
  if (share === null) return null;
  const { from, to } = shownSpan();
  return from + share * (to - from);
}

/** The sample that a reading is of: the one under the pointer, or the newest on screen; -1: none. */
export function sampleRead(): number {
  const ring = shownRing();
  const time = hoverTime();
  return time === null ? ring.nearestTo(shownSpan().to) : ring.sampleAt(time);
}
