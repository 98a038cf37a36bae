/** One uPlot of the replay: curves that stand still, a line at the present time. */
import uPlot from "uplot";
import { plainAxis, valueAxis } from "../plots/axes";
import { drawEventLines, type RunEvent } from "../plots/eventlines";
import { palette } from "../plots/palette";
import { niceRange } from "../plots/range";
import { text } from "../text/replay";
import { range, seek, showAll, showRange, timeS } from "./clock";
import type { Curve } from "./curves";
import { drawEventLabels } from "./marks";

const X_AXIS_PX = 24;
const LABELS_PX = 17;
const SMALLEST_DRAG_PX = 4;

export interface ChartContent {
  time: Float64Array;
  curves: readonly Curve[];
  span: number;
  events: readonly RunEvent[];
  isFirst: boolean;
  isLast: boolean;
}

export class Chart {
  readonly #plot: uPlot;
  readonly #now = document.createElement("div");

  constructor(
    host: HTMLElement,
    private readonly content: ChartContent,
    onCursor: () => void,
  ) {
    const { events, isFirst, isLast } = content;
    const { from, to } = range.peek();
    this.#now.className = "now";
    this.#plot = new uPlot(
      {
        width: Math.max(1, host.clientWidth),
        height: Math.max(1, host.clientHeight),
        padding: [isFirst ? LABELS_PX : 8, 12, isLast ? 0 : 7, 0],
        legend: { show: false },
        cursor: {
          y: false,
          drag: { x: true, y: false, setScale: false },
          points: { size: 6 },
          sync: { key: "replay", scales: ["x", null] },
          bind: { dblclick: () => showWhole },
        },
        scales: {
          x: { time: false, min: from, max: to },
          y: { range: (_, low, high) => niceRange(low, high, content.span) },
        },
        axes: [timeAxis(isLast), valueAxis()],
        series: [{}, ...content.curves.map(drawnCurve)],
        hooks: {
          drawClear: [(plot) => drawEventLines(plot, events)],
          draw: [
            ...(isFirst ? [(plot: uPlot) => drawEventLabels(plot, events)] : []),
            () => this.showTime(),
          ],
          setCursor: [onCursor],
          setSelect: [select],
        },
      },
      [content.time, ...content.curves.map((curve) => withGaps(curve.values))],
      host,
    );
    this.#plot.over.append(this.#now);
    this.#plot.over.addEventListener("click", (event) => {
      seek(this.#plot.posToVal(event.offsetX, "x"));
    });
    this.showRange();
  }

  showRange(): void {
    const { from: min, to: max } = range.peek();
    this.#plot.setScale("x", { min, max });
  }

  showTime(): void {
    const { from, to } = range.peek();
    const time = timeS.peek();
    this.#now.hidden = time < from || time > to;
    this.#now.style.translate = `${this.#plot.valToPos(time, "x").toFixed(2)}px`;
  }

  redraw(): void {
    this.#plot.redraw(false);
  }

  /** Value of a curve at the pointer, or else at the present time. */
  reading(index: number): number {
    const { time, curves } = this.content;
    const step = (time[1] ?? 1) - (time[0] ?? 0);
    const now = Math.min(Math.round(timeS.peek() / step), time.length - 1);
    return curves[index]?.values[this.#plot.cursor.idx ?? now] ?? Number.NaN;
  }

  show(index: number, isShown: boolean): void {
    this.#plot.setSeries(index + 1, { show: isShown });
  }

  resize(width: number, height: number): void {
    if (width > 0 && height > 0) this.#plot.setSize({ width, height });
  }

  destroy(): void {
    this.#plot.destroy();
  }
}

/** Values with null, which uPlot leaves out, for NaN; the same array where there is none. */
function withGaps(values: Float32Array): Float32Array | (number | null)[] {
  if (!values.some(Number.isNaN)) return values;
  return Array.from(values, (value) => (Number.isNaN(value) ? null : value));
}

function showWhole(): null {
  showAll();
  return null;
}

/** A drag over a plot shows that part of the run. */
function select(plot: uPlot): void {
  const { left, width } = plot.select;
  if (width === 0) return;
  plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  if (width < SMALLEST_DRAG_PX) return;
  showRange(plot.posToVal(left, "x"), plot.posToVal(left + width, "x"));
}

const timeAxis = (isLast: boolean): uPlot.Axis => ({
  ...plainAxis(),
  size: isLast ? X_AXIS_PX : 0,
  space: 70,
  values: (_, splits) => splits.map((value) => (isLast ? text.plots.timeTick(value) : "")),
});

/** Not moved to whole pixels, which would turn a slow curve into steps. */
function drawnCurve(curve: Curve): uPlot.Series {
  return {
    label: curve.label,
    stroke: () => palette.peek()[curve.colour],
    width: curve.width,
    dash: [...curve.dash],
    points: { show: false },
    pxAlign: 0,
  };
}
