/** Arithmetic of time spans. */
import { MAX_WINDOW_S, type SampleRing } from "../stream/ring";

/** Limits of the time axis, s. */
export interface Span {
  from: number;
  to: number;
}

const SHORTEST_S = 0.05;

/** The span widened by `factor` (narrowed below 1); the time `around` keeps its position. */
export function zoomSpan({ from, to }: Span, factor: number, around: number): Span {
  const length = Math.min(MAX_WINDOW_S, Math.max(SHORTEST_S, (to - from) * factor));
  const share = (around - from) / (to - from);
  return { from: around - share * length, to: around + (1 - share) * length };
}

/** The span moved so that at least half of it has samples, if there are any. */
export function clampSpan({ from, to }: Span, oldest: number, newest: number): Span {
  if (Number.isNaN(oldest)) return { from, to };
  const half = (to - from) / 2;
  const middle = Math.min(newest, Math.max(oldest, from + half));
  return { from: middle - half, to: middle + half };
}

export function liveSpan(ring: SampleRing, lengthS: number): Span {
  const to = Math.max(Number.isNaN(ring.newestTime) ? 0 : ring.newestTime, lengthS);
  return { from: to - lengthS, to };
}

/** Whether any sample of a span is stored, or may still come. */
export function mayHaveSamples(ring: SampleRing, { from, to }: Span): boolean {
  if (!(ring.newestTime >= to)) return true;
  for (let index = ring.lowerBound(from); ring.timeAt(index) < to; index++) {
    if (ring.channels.some((name) => !Number.isNaN(ring.valueAt(name, index)))) return true;
  }
  return false;
}
