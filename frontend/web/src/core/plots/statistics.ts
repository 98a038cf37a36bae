/** What lies between two samples of one curve, and what a step did to the position. */
import type { SampleRing } from "../stream/ring";

export interface Measures {
  a: number;
  b: number;
  delta: number;
  min: number;
  max: number;
  rms: number;
  /** For so long of it there is no number, s: min, max and rms are of the rest. */
  missingS: number;
}

/** Of the samples from index `a` to `b`, both included, past what is no number. */
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

/** How long there is no number, s, from the sample at index `first` up to the one at `last`. */
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

export interface StepMetrics {
  peak: number;
  rms: number;
  /**
   * From the step until the error stays small, s; null while it has not for long enough, NaN where
   * samples are missing, for the error may have been large in between.
   */
  recoveryS: number | null;
  /** For so long of it there is no number, s: the true peak may be higher. */
  missingS: number;
}

/** As the server has it: within 2 % of the peak so far for half a second; it stays what it was. */
export const RECOVERY_SHARE = 0.02;
const STEADY_STATE_S = 0.5;

/**
 * The error from a time on up to before another, of the samples held; null where none is held of
 * its beginning.
 */
export function measureStep(
  ring: SampleRing,
  channel: string,
  lane: number,
  fromS: number,
  toS: number,
): StepMetrics | null {
  const first = ring.firstAt(fromS);
  const end = Math.min(ring.length, ring.firstAt(toS));
  const beginsBefore = first === 0 && ring.oldestTime > fromS + 0.1;
  if (first >= end || beginsBefore) return null;
  let peak = 0;
  let squares = 0;
  let count = 0;
  let lastOutside = fromS;
  let recoveryS: number | null = null;
  for (let index = first; index < end; index++) {
    const size = Math.abs(ring.valueAt(channel, index, lane));
    if (Number.isNaN(size)) continue;
    peak = Math.max(peak, size);
    squares += size * size;
    count++;
    if (size > RECOVERY_SHARE * peak) lastOutside = ring.timeAt(Math.min(index + 1, end - 1));
    if (recoveryS === null && ring.timeAt(index) - lastOutside >= STEADY_STATE_S) {
      recoveryS = lastOutside - fromS;
    }
  }
  if (count === 0) return null;
  const missingS = measureMissing(ring, channel, lane, first, end - 1);
  return {
    peak,
    rms: Math.sqrt(squares / count),
    recoveryS: missingS > 0 ? Number.NaN : recoveryS,
    missingS,
  };
}
