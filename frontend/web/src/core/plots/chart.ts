/** One plot over time: uPlot draws scales, axes and grid; a layer on top draws the curves. */
import uPlot from "uplot";
import { session } from "../state/session";
import { includeBounds, niceRange, RIGHT_PX, timeGrid, valueAxis } from "./axes";
import { boundsOf } from "./channels";
import { Curve } from "./curves";
import { extentOf } from "./decimation";
import type { Bound, Trace } from "./definitions";
import { drawEventLines } from "./eventlines";
import { type Frame, StrokeLayer } from "./layer";
import { drawBeginning, drawBounds, drawCursorSamples } from "./marks";
import type { ChartView } from "./span";
import { plotIn } from "./staticchart";

const MARGIN_PX = 6;

export class Chart {
  readonly plot: uPlot;
  readonly #curves: readonly Curve[];
  readonly #layer = new StrokeLayer();
  #shown: readonly Curve[];
  #bounds: readonly Bound[] = [];
  #perBucketS = 0;
  /** Source of the curves: a plot that redraws on its own receives no newer samples. */
  #taken: Pick<Frame, "ring" | "span" | "newest"> | null = null;

  constructor(
    host: HTMLElement,
    traces: readonly Trace[],
    private readonly minSpan: number,
    private readonly view: ChartView,
  ) {
    this.#curves = traces.map((trace) => new Curve(trace));
    this.#shown = this.#curves;
    this.plot = plotIn(
      host,
      {
        padding: [MARGIN_PX, RIGHT_PX, MARGIN_PX, 0],
        scales: { x: { time: false, auto: false }, y: { auto: false } },
        axes: [timeGrid(), valueAxis()],
        series: [{}],
        hooks: {
          drawClear: [(plot) => drawEventLines(plot, session.peek()?.events ?? [])],
          draw: [() => this.#drawStrokes()],
        },
      },
      [[0, 1]],
    );
  }

  draw(): void {
    const ring = this.view.ring();
    const span = this.view.span();
    const pixels = this.plot.bbox.width / uPlot.pxRatio;
    this.#taken = { ring, span, newest: ring.newestTime };
    for (const curve of this.#curves) {
      const perBucket = curve.fill(ring, span, pixels);
      this.#perBucketS = perBucket * (ring.newestTime - ring.timeAt(ring.length - 2));
    }
    this.#bounds = boundsOf(
      this.#shown.map(({ trace }) => trace),
      session.peek(),
    );
    const [min, max] = this.#range();
    this.plot.batch(() => {
      this.plot.setData([[span.from, span.to]], false);
      this.plot.setScale("x", { min: span.from, max: span.to });
      this.plot.setScale("y", { min, max });
    });
  }

  /** Hide the curves of these keys, and those that belong to them. */
  hide(hidden: ReadonlySet<string>): void {
    this.#shown = this.#curves.filter(({ trace: { key, follows } }) => !hidden.has(follows ?? key));
  }

  #drawStrokes(): void {
    const { ctx, bbox, scales } = this.plot;
    const { min = 0, max = 1 } = scales.y as uPlot.Scale;
    const { width, height } = bbox;
    if (this.#taken && this.#perBucketS > 0 && width > 0 && height > 0) {
      const frame = { ...this.#taken, min, max, width, height, shown: this.#shown };
      this.#layer.draw(frame, this.#perBucketS);
      this.#layer.paint(ctx, bbox.left, bbox.top);
    }
    drawBounds(this.plot, this.#bounds);
    drawBeginning(this.plot, this.#shown, this.view.ring());
    if (this.view.hasCursors) drawCursorSamples(this.plot, this.#shown);
  }

  #range(): [number, number] {
    const [low, high] = extentOf(this.#shown.map(({ points }) => points));
    const [bottom, top] = niceRange(low, high, this.minSpan);
    return includeBounds(
      bottom,
      top,
      this.#bounds.map((bound) => bound.value),
    );
  }
}
