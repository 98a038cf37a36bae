/** Curves: the points of the visible span, strokes and markers. */
import uPlot from "uplot";
import type { SampleRing } from "../stream/ring";
import { BAND_OPACITY, type Banded, bandsOf } from "./bands";
import { decimate, emptyPoints, type Points, samplesPerBucket } from "./decimation";
import { type PlotSign, samplesOf, type Trace } from "./definitions";
import { palette } from "./linestyles";
import type { Span } from "./spans";

/** Map time and value to the pixels of a canvas. */
export interface Place {
  x(value: number): number;
  y(value: number): number;
}

const SIGN_PX = 3.5;
const BETWEEN_SIGNS_PX = 72;

export class Curve {
  readonly points: Points = emptyPoints();
  /** A point and the length of the curve up to it, which keeps the dash pattern in place. */
  #anchor = { time: Number.NaN, length: 0 };

  constructor(readonly trace: Trace) {}

  /**
   * Take the samples in the span, and one beyond each end; returns the number of samples per
   * bucket.
   */
  fill(ring: SampleRing, { from, to }: Span, pixels: number): number {
    const { channel, lane, factor } = this.trace;
    const { first, end } = samplesOf(
      ring,
      this.trace,
      ring.lowerBound(from) - 1,
      ring.lowerBound(to) + 2,
    );
    const segment = ring.segment(channel, lane, first, end);
    this.points.count = 0;
    if (segment === null) return 1;
    const perBucket = samplesPerBucket(segment.count, pixels);
    decimate(segment, perBucket, factor, this.points);
    return perBucket;
  }

  /** Restart the dash pattern. */
  forget(): void {
    this.#anchor = { time: Number.NaN, length: 0 };
  }

  /** Draw the curve from the last point left of `fromX`. */
  stroke(context: CanvasRenderingContext2D, place: Place, fromX: number): void {
    const { dash, width, colour } = this.trace;
    const ratio = uPlot.pxRatio;
    const begin = this.#firstPoint(place, fromX);
    context.strokeStyle = palette.peek()[colour];
    context.lineWidth = width * ratio;
    context.lineJoin = "round";
    if (dash.length === 0) {
      context.setLineDash([]);
    } else {
      context.setLineDash(dash.map((length) => length * ratio));
      context.lineDashOffset = this.#lengthAt(begin, place);
    }
    context.stroke(pathOf(this.points, place, begin));
  }

  #firstPoint(place: Place, fromX: number): number {
    const { x, count } = this.points;
    let index = 0;
    for (let next = 0; next < count; next++) {
      const at = place.x(x[next] as number);
      if (at >= fromX) break;
      if (!Number.isNaN(at)) index = next;
    }
    return index;
  }

  /** Length of the curve up to a point, measured from the anchor, which moves there. */
  #lengthAt(index: number, place: Place): number {
    const { x, y } = this.points;
    let at = index;
    while (at > 0 && x[at] !== this.#anchor.time) at--;
    const isFound = x[at] === this.#anchor.time;
    let length = isFound ? this.#anchor.length : 0;
    for (let next = isFound ? at + 1 : index + 1; next <= index; next++) {
      const across = place.x(x[next] as number) - place.x(x[next - 1] as number);
      const up = place.y(y[next] as number) - place.y(y[next - 1] as number);
      const step = Math.hypot(across, up);
      if (!Number.isNaN(step)) length += step;
    }
    this.#anchor = { time: x[index] ?? Number.NaN, length };
    return length;
  }
}

/** Path through the points from one index on; NaN interrupts the path. */
export function pathOf({ x: xs, y: ys, count }: Points, place: Place, begin = 0): Path2D {
  const path = new Path2D();
  let isDown = false;
  for (let index = begin; index < count; index++) {
    const y = ys[index] as number;
    if (Number.isNaN(y)) {
      isDown = false;
      continue;
    }
    if (isDown) path.lineTo(place.x(xs[index] as number), place.y(y));
    else path.moveTo(place.x(xs[index] as number), place.y(y));
    isDown = true;
  }
  return path;
}

export function fillBands(
  context: CanvasRenderingContext2D,
  curves: readonly Banded[],
  place: Place,
): void {
  context.globalAlpha = BAND_OPACITY;
  for (const { colour, outline } of bandsOf(curves)) {
    context.fillStyle = palette.peek()[colour];
    context.fill(pathOf(outline, place));
  }
  context.globalAlpha = 1;
}

/** Map from the scales of a plot to its canvas. */
export function placeOn({ scales, bbox }: uPlot): Place {
  const { min: left = 0, max: right = 1 } = scales.x as uPlot.Scale;
  const { min: bottom = 0, max: top = 1 } = scales.y as uPlot.Scale;
  const perX = bbox.width / (right - left);
  const perY = bbox.height / (top - bottom);
  return {
    x: (value) => bbox.left + (value - left) * perX,
    y: (value) => bbox.top + (top - value) * perY,
  };
}

export function addSign(path: Path2D, sign: PlotSign, x: number, y: number, size: number): void {
  if (sign === "circle") {
    path.moveTo(x + size, y);
    path.arc(x, y, size, 0, 2 * Math.PI);
  } else if (sign === "square") {
    path.rect(x - size, y - size, 2 * size, 2 * size);
  } else if (sign === "triangle") {
    path.moveTo(x, y - 1.2 * size);
    path.lineTo(x + 1.1 * size, y + 0.8 * size);
    path.lineTo(x - 1.1 * size, y + 0.8 * size);
    path.closePath();
  }
}

/** Markers along a curve at round times, so that they move with it; from a pixel on. */
export function drawSigns(
  context: CanvasRenderingContext2D,
  { trace, points }: Curve,
  place: Place,
  fromX: number,
): void {
  if (trace.sign === "none") return;
  const ratio = uPlot.pxRatio;
  const between = (BETWEEN_SIGNS_PX * ratio) / (place.x(1) - place.x(0));
  const path = new Path2D();
  let turn = Number.NaN;
  for (let index = 0; index < points.count; index++) {
    const time = points.x[index] as number;
    const y = place.y(points.y[index] as number);
    if (Number.isNaN(y)) continue;
    const next = Math.floor(time / between + 0.25 * trace.lane);
    const isSign = next > turn;
    turn = next;
    const x = place.x(time);
    if (isSign && x >= fromX - 2 * SIGN_PX * ratio)
      addSign(path, trace.sign, x, y, SIGN_PX * ratio);
  }
  context.fillStyle = palette.peek()[trace.colour];
  context.fill(path);
}
