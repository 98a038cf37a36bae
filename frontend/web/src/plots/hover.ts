/** The time under the pointer, the same in all plots. */
import { signal } from "@preact/signals";
import { shownRing, shownSpan } from "./span";

/** Where the pointer is on the axis, 0 to 1; null where it is not over a plot. */
export const hoverShare = signal<number | null>(null);

/** The sample that a reading is of: the one under the pointer, or the newest on screen; -1: none. */
export function sampleRead(): number {
  const ring = shownRing();
  const { from, to } = shownSpan();
  const share = hoverShare.peek();
  const time = share === null ? to : from + share * (to - from);
  const index = ring.nearestTo(time);
  return share !== null && time > ring.newestTime + 0.02 ? -1 : index;
}
