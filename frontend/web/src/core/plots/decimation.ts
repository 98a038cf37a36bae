/** Fewer points with the same look: the smallest and the largest sample of each bucket. */
import type { Segment } from "../stream/ring";

/** Points to draw; NaN separates two pieces of the curve. */
export interface Points {
  x: Float64Array;
  y: Float64Array;
  count: number;
}

export const emptyPoints = (): Points => ({
  x: new Float64Array(0),
  y: new Float64Array(0),
  count: 0,
});

/** Number of samples per bucket, so that there is at most one bucket per pixel. */
export const samplesPerBucket = (samples: number, pixels: number): number =>
  Math.max(1, Math.ceil(samples / Math.max(1, pixels)));

export function makeRoom(points: Points, count: number): void {
  if (points.x.length >= count) return;
  points.x = new Float64Array(count);
  points.y = new Float64Array(count);
}

export function put(points: Points, x: number, y: number): void {
  points.x[points.count] = x;
  points.y[points.count++] = y;
}

/** Insert one interruption of the path. */
export function lift(points: Points): void {
  const isLifted = points.count > 0 && Number.isNaN(points.y[points.count - 1]);
  if (!isLifted) put(points, Number.NaN, Number.NaN);
}

function copyAll({ time, values, start, count }: Segment, factor: number, out: Points): void {
  makeRoom(out, count);
  let slot = start;
  for (let index = 0; index < count; index++) {
    put(out, time[slot] as number, (values[slot] as number) * factor);
    slot = slot + 1 === values.length ? 0 : slot + 1;
  }
}

/**
 * Write the points of a segment, times `factor`, into `out`. Buckets begin at multiples of
 * `perBucket` of the sample number, so that they do not change while time advances. Only real
 * samples are used, in the order of time; a gap stays a gap, and ends a bucket.
 */
export function decimate(segment: Segment, perBucket: number, factor: number, out: Points): void {
  out.count = 0;
  if (perBucket <= 2) {
    copyAll(segment, factor, out);
    return;
  }
  const { time, values, start, count, number } = segment;
  makeRoom(out, count + 2);
  const after = (slot: number) => (slot + 1 === values.length ? 0 : slot + 1);
  let slot = start;
  let index = 0;
  let bucketEnd = perBucket - (number % perBucket);
  while (index < count) {
    if (Number.isNaN(values[slot])) {
      lift(out);
      slot = after(slot);
      index++;
      continue;
    }
    while (bucketEnd <= index) bucketEnd += perBucket;
    const end = Math.min(count, bucketEnd);
    let lowSlot = slot;
    let highSlot = slot;
    for (; index < end && !Number.isNaN(values[slot]); index++) {
      if ((values[slot] as number) < (values[lowSlot] as number)) lowSlot = slot;
      if ((values[slot] as number) > (values[highSlot] as number)) highSlot = slot;
      slot = after(slot);
    }
    const isLowFirst = (time[lowSlot] as number) <= (time[highSlot] as number);
    const [first, last] = isLowFirst ? [lowSlot, highSlot] : [highSlot, lowSlot];
    put(out, time[first] as number, (values[first] as number) * factor);
    if (first !== last) put(out, time[last] as number, (values[last] as number) * factor);
  }
}

/** Smallest and largest y, or x, of all points; null without points. */
export function extentOf(
  curves: Iterable<Points>,
  way: "x" | "y" = "y",
): readonly [number | null, number | null] {
  let low = Number.POSITIVE_INFINITY;
  let high = Number.NEGATIVE_INFINITY;
  for (const points of curves) {
    for (let index = 0; index < points.count; index++) {
      const value = points[way][index] as number;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? [low, high] : [null, null];
}
