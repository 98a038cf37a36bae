/** The phase plane: one channel over another, a curve a lane, of the span that all plots show. */
import uPlot from "uplot";
import type { SampleRing, Stretch } from "../stream/ring";
import { LEFT_PX, niceRange, otherAxis, RIGHT_PX, valueAxis } from "./axes";
import { cursorSamples } from "./cursors";
import { addSign, Curve, pathOf, placeOn } from "./curves";
import { makeRoom } from "./decimation";
import { isWithin, samplesOf, type Trace } from "./definitions";
import { palette } from "./linestyles";
import { shownRing, shownSpan } from "./span";

const X_AXIS_PX = 24;
const MARGIN_PX = 6;
const MIN_STEP_PX = 2;
/** Thin, for the loops of many periods lie close together. */
const STROKE_WIDTH = 1;
const SIGN_PX = 4;

interface PhaseAxes {
  x: { channel: string; factor: number; span: number };
  y: { channel: string; factor: number; span: number };
}

interface Limits {
  x: [number, number];
  y: [number, number];
}

function extend([low, high]: [number, number], { values, start, count }: Stretch, factor: number) {
  let [min, max] = [low, high];
  let slot = start;
  for (let index = 0; index < count; index++) {
    const value = (values[slot] as number) * factor;
    if (value < min) min = value;
    if (value > max) max = value;
    slot = slot + 1 === values.length ? 0 : slot + 1;
  }
  return [min, max] as [number, number];
}

export class PhaseChart {
  readonly #plot: uPlot;
  readonly #curves: readonly Curve[];
  #shown: readonly Curve[];

  /** @param traces one a lane; their channel is the one of the upright axis */
  constructor(
    host: HTMLElement,
    traces: readonly Trace[],
    private readonly axes: PhaseAxes,
  ) {
    this.#curves = traces.map((trace) => new Curve({ ...trace, width: STROKE_WIDTH }));
    this.#shown = this.#curves;
    this.#plot = new uPlot(
      {
        width: Math.max(1, host.clientWidth),
        height: Math.max(1, host.clientHeight),
        padding: [MARGIN_PX, RIGHT_PX, 0, 0],
        legend: { show: false },
        cursor: { show: false },
        scales: { x: { time: false, auto: false }, y: { auto: false } },
        axes: [otherAxis(X_AXIS_PX), { ...valueAxis(), size: LEFT_PX }],
        series: [{}],
        hooks: { draw: [(plot) => this.#drawCurves(plot), (plot) => this.#drawPlaces(plot)] },
      },
      [[0, 1]],
      host,
    );
  }

  draw(): void {
    const ring = shownRing();
    const span = shownSpan();
    const first = ring.firstAt(span.from);
    const end = ring.firstAt(span.to) + 1;
    const { x, y } = this.#limits(ring, first, end);
    for (const curve of this.#shown) this.#fill(curve, ring, first, end, { x, y });
    this.#plot.batch(() => {
      this.#plot.setData([x], false);
      this.#plot.setScale("x", { min: x[0], max: x[1] });
      this.#plot.setScale("y", { min: y[0], max: y[1] });
    });
  }

  hide(hidden: ReadonlySet<string>): void {
    this.#shown = this.#curves.filter(({ trace }) => !hidden.has(trace.follows ?? trace.key));
  }

  resize(width: number, height: number): void {
    if (width > 0 && height > 0) this.#plot.setSize({ width, height });
  }

  destroy(): void {
    this.#plot.destroy();
  }

  #limits(ring: SampleRing, first: number, end: number): Limits {
    const reach = (axis: PhaseAxes["x"]): [number, number] => {
      let extent: [number, number] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
      for (const { trace } of this.#shown) {
        const own = samplesOf(ring, trace, first, end);
        const stretch = ring.stretch(axis.channel, trace.lane, own.first, own.end);
        if (stretch !== null) extent = extend(extent, stretch, axis.factor);
      }
      const [low, high] = extent;
      return niceRange(low, high, axis.span);
    };
    return { x: reach(this.axes.x), y: reach(this.axes.y) };
  }

  /** Samples that a reader can tell from the one before. */
  #fill({ trace, points }: Curve, ring: SampleRing, first: number, end: number, limits: Limits) {
    const own = samplesOf(ring, trace, first, end);
    const across = ring.stretch(this.axes.x.channel, trace.lane, own.first, own.end);
    const up = ring.stretch(this.axes.y.channel, trace.lane, own.first, own.end);
    points.count = 0;
    if (across === null || up === null) return;
    makeRoom(points, across.count);
    const { width, height } = this.#plot.bbox;
    const minX = (MIN_STEP_PX / width) * (limits.x[1] - limits.x[0]);
    const minY = (MIN_STEP_PX / height) * (limits.y[1] - limits.y[0]);
    let lastX = Number.NaN;
    let lastY = Number.NaN;
    let slot = across.start;
    for (let index = 0; index < across.count; index++) {
      const x = (across.values[slot] as number) * this.axes.x.factor;
      const y = (up.values[slot] as number) * this.axes.y.factor;
      slot = slot + 1 === across.values.length ? 0 : slot + 1;
      if (Math.abs(x - lastX) < minX && Math.abs(y - lastY) < minY) continue;
      points.x[points.count] = x;
      points.y[points.count++] = Number.isNaN(x) ? x : y;
      lastX = x;
      lastY = y;
    }
  }

  #drawCurves(plot: uPlot): void {
    const { ctx: context } = plot;
    const place = placeOn(plot);
    context.save();
    for (const { trace, points } of this.#shown) {
      context.strokeStyle = palette.peek()[trace.colour];
      context.lineWidth = trace.width * uPlot.pxRatio;
      context.setLineDash(trace.dash.map((length) => length * uPlot.pxRatio));
      context.stroke(pathOf(points, place));
    }
    context.restore();
  }

  /** Where each lane is: now, or under the cursors. */
  #drawPlaces(plot: uPlot): void {
    const ring = shownRing();
    const newest = ring.firstAt(shownSpan().to + 1e-9) - 1;
    const indices = cursorSamples.peek() ?? [newest];
    const to = placeOn(plot);
    for (const { trace } of this.#shown) {
      plot.ctx.fillStyle = palette.peek()[trace.colour];
      indices.forEach((index, which) => {
        if (!isWithin(trace, ring.timeAt(index))) return;
        const x = ring.valueAt(this.axes.x.channel, index, trace.lane) * this.axes.x.factor;
        const y = ring.valueAt(this.axes.y.channel, index, trace.lane) * this.axes.y.factor;
        const path = new Path2D();
        const sign = which === 0 ? "circle" : "square";
        addSign(path, sign, to.x(x), to.y(y), SIGN_PX * uPlot.pxRatio);
        plot.ctx.fill(path);
      });
    }
  }
}
