/** The phase plane: one channel over another, one curve per lane, in the span of all plots. */
import uPlot from "uplot";
import type { SampleRing } from "../stream/ring";
import { niceRange, otherAxis, RIGHT_PX, valueAxis } from "./axes";
import { CHANNELS, type ChannelName } from "./channels";
import { cursorSamples } from "./cursors";
import { addSign, pathOf, placeOn } from "./curves";
import { emptyPoints, extentOf, makeRoom, type Points } from "./decimation";
import { isWithin, samplesOf, type Trace } from "./definitions";
import { palette } from "./linestyles";
import { shownRing, shownSpan } from "./span";
import { plotIn } from "./staticchart";

const MARGIN_PX = 6;
const MIN_STEP_PX = 2;
/** Thin, because the loops of many periods are close together. */
const STROKE_WIDTH = 1;
const SIGN_PX = 4;

/** Horizontal and vertical channel. */
export type PhaseChannels = readonly [ChannelName, ChannelName];

interface PhaseCurve {
  /** Limits of the vertical channel. */
  trace: Trace;
  points: Points;
}

/** Every sample of the visible span, in the units on screen. */
function takeSamples({ trace, points }: PhaseCurve, channels: PhaseChannels, ring: SampleRing) {
  const { from, to } = shownSpan();
  const { first, end } = samplesOf(ring, trace, ring.lowerBound(from), ring.lowerBound(to) + 1);
  points.count = Math.max(0, Math.min(end, ring.length) - first);
  makeRoom(points, points.count);
  for (const [index, channel] of channels.entries()) {
    const out = (index === 0 ? points.x : points.y).subarray(0, points.count);
    ring.copyChannel(channel, first, out, CHANNELS[channel].factor, trace.lane);
  }
}

/** The samples of the curves, and the limits of both axes. */
export function takePhase(curves: readonly PhaseCurve[], channels: PhaseChannels) {
  for (const curve of curves) takeSamples(curve, channels, shownRing());
  const points = curves.map((curve) => curve.points);
  const [x, y] = (["x", "y"] as const).map((way, index) =>
    niceRange(...extentOf(points, way), CHANNELS[channels[index] as ChannelName].span),
  ) as [[number, number], [number, number]];
  return { x, y };
}

/** Keep only points that are visibly different from the previous one. */
function thin(points: Points, minX: number, minY: number): void {
  const { x, y, count } = points;
  let keptCount = 0;
  for (let index = 0; index < count; index++) {
    const across = Math.abs((x[index] as number) - (x[keptCount - 1] ?? Number.NaN));
    const up = Math.abs((y[index] as number) - (y[keptCount - 1] ?? Number.NaN));
    if (across < minX && up < minY) continue;
    x[keptCount] = x[index] as number;
    y[keptCount++] = Number.isNaN(x[index]) ? Number.NaN : (y[index] as number);
  }
  points.count = keptCount;
}

export class PhaseChart {
  readonly plot: uPlot;
  readonly #curves: readonly PhaseCurve[];
  #shown: readonly PhaseCurve[];

  constructor(
    host: HTMLElement,
    traces: readonly Trace[],
    private readonly channels: PhaseChannels,
  ) {
    this.#curves = traces.map((trace) => ({ trace, points: emptyPoints() }));
    this.#shown = this.#curves;
    this.plot = plotIn(
      host,
      {
        padding: [MARGIN_PX, RIGHT_PX, 0, 0],
        scales: { x: { time: false, auto: false }, y: { auto: false } },
        axes: [otherAxis("x"), valueAxis()],
        series: [{}],
        hooks: { draw: [() => this.#drawCurves(), () => this.#drawPlaces()] },
      },
      [[0, 1]],
    );
  }

  draw(): void {
    const { x, y } = takePhase(this.#shown, this.channels);
    const { width, height } = this.plot.bbox;
    const [perX, perY] = [(x[1] - x[0]) / width, (y[1] - y[0]) / height];
    for (const { points } of this.#shown) thin(points, MIN_STEP_PX * perX, MIN_STEP_PX * perY);
    this.plot.batch(() => {
      this.plot.setData([x], false);
      this.plot.setScale("x", { min: x[0], max: x[1] });
      this.plot.setScale("y", { min: y[0], max: y[1] });
    });
  }

  hide(hidden: ReadonlySet<string>): void {
    this.#shown = this.#curves.filter(({ trace }) => !hidden.has(trace.follows ?? trace.key));
  }

  #drawCurves(): void {
    const { ctx: context } = this.plot;
    const place = placeOn(this.plot);
    context.save();
    for (const { trace, points } of [...this.#shown].reverse()) {
      context.strokeStyle = palette.peek()[trace.colour];
      context.lineWidth = STROKE_WIDTH * uPlot.pxRatio;
      context.setLineDash(trace.dash.map((length) => length * uPlot.pxRatio));
      context.stroke(pathOf(points, place));
    }
    context.restore();
  }

  /** Position of each lane: now, or under the cursors. */
  #drawPlaces(): void {
    const ring = shownRing();
    const newest = ring.lowerBound(shownSpan().to + 1e-9) - 1;
    const to = placeOn(this.plot);
    for (const { trace } of this.#shown) {
      this.plot.ctx.fillStyle = palette.peek()[trace.colour];
      for (const [which, index] of (cursorSamples.peek() ?? [newest]).entries()) {
        if (!isWithin(trace, ring.timeAt(index))) continue;
        const [x, y] = this.channels.map(
          (channel) => ring.valueAt(channel, index, trace.lane) * CHANNELS[channel].factor,
        ) as [number, number];
        const path = new Path2D();
        const sign = which === 0 ? "circle" : "square";
        addSign(path, sign, to.x(x), to.y(y), SIGN_PX * uPlot.pxRatio);
        this.plot.ctx.fill(path);
      }
    }
  }
}
