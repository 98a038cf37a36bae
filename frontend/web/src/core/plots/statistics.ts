/** Statistics between two samples of one curve. */
import type { SampleRing } from "../stream/ring";

export interface Measures {
  a: number;
  b: number;
  delta: number;
  min: number;
  max: number;
  rms: number;
  /** Duration without values, s: min, max and rms are of the rest. */
  missingS: number;
}

/** Statistics of the samples from index `a` to `b`, both included; NaN is left out. */
export function measureBetween(
  ring: SampleRing,
  channel: string,
  lane: number,
  [a, b]: readonly [number, number],
  factor = 1,
): Measures {
  const atA = ring.valueAt(channel, a, lane) * factor;
  const atB = ring.valueAt(channel, b, lane) * factor;
  let min = Number.NaN;
  let max = Number.NaN;
  let squares = 0;
  let count = 0;
  const end = Math.max(a, b);
  for (let index = Math.min(a, b); index <= end; index++) {
    const value = ring.valueAt(channel, index, lane) * factor;
    if (Number.isNaN(value)) continue;
    if (!(value >= min)) min = value;
    if (!(value <= max)) max = value;
    squares += value * value;
    count++;
  }
  const rms = count === 0 ? Number.NaN : Math.sqrt(squares / count);
  const missingS = measureMissing(ring, channel, lane, Math.min(a, b), end);
  return { a: atA, b: atB, delta: atB - atA, min, max, rms, missingS };
}

/** Duration without values, s, from the sample at index `first` up to the one at `last`. */
function measureMissing(
  ring: SampleRing,
  channel: string,
  lane: number,
  first: number,
  last: number,
): number {
  let missing = 0;
  for (let index = first; index < last; index++) {
    if (!Number.isNaN(ring.valueAt(channel, index, lane))) continue;
    missing += ring.timeAt(index + 1) - ring.timeAt(index);
  }
  return missing;
}
