/** One uPlot: made from a definition and one of its choices, fed from the ring without allocating samples. */
import uPlot from "uplot";
import { LONGEST_WINDOW_S, RATE_HZ, samples, session } from "../state/session";
import { text } from "../text/en";
import { formatNumber } from "../units";
import type { Bound, PlotChoice, PlotDefinition, Trace } from "./definitions";
import type { TimeView } from "./frame";
import { drawBounds, drawEventLabels, drawEvents } from "./marks";
import { palette } from "./palette";
import { extentOf, includeBounds, niceRange } from "./range";

const Y_AXIS_PX = 50;
const X_AXIS_PX = 24;
const LABELS_PX = 17;
const TIME_STEPS_S = [0.1, 0.2, 0.5, 1, 2, 5, 10];
const FONT = "11px system-ui, sans-serif";

export interface ChartPlace {
  isFirst: boolean;
  isLast: boolean;
}

export class Chart {
  readonly #plot: uPlot;
  readonly #columns: Float32Array[];
  #view: TimeView | null = null;

  constructor(
    host: HTMLElement,
    private readonly definition: PlotDefinition,
    private readonly choice: PlotChoice,
    place: ChartPlace,
    onCursor: () => void,
  ) {
    const capacity = LONGEST_WINDOW_S * RATE_HZ + 1;
    this.#columns = choice.traces.map(() => new Float32Array(capacity));
    this.#plot = new uPlot(
      {
        width: Math.max(1, host.clientWidth),
        height: Math.max(1, host.clientHeight),
        padding: [place.isFirst ? LABELS_PX : 8, 10, place.isLast ? 0 : 7, 0],
        legend: { show: false },
        cursor: {
          y: false,
          drag: { x: false, y: false },
          points: { size: 7 },
          sync: { key: "svsa", scales: ["x", null] },
        },
        scales: { x: { time: false }, y: { range: () => this.#range() } },
        axes: [this.#timeAxis(place.isLast), this.#valueAxis()],
        series: [{}, ...choice.traces.map(drawnTrace)],
        hooks: {
          drawClear: [drawEvents],
          draw: [
            (plot) => drawBounds(plot, this.#bounds()),
            ...(place.isFirst ? [drawEventLabels] : []),
          ],
          setCursor: [onCursor],
        },
      },
      [[], ...choice.traces.map(() => [])],
      host,
    );
  }

  draw(view: TimeView): void {
    this.#view = view;
    const count = view.time.length;
    const { factor } = this.definition;
    const columns = this.choice.traces.map((trace, index) => {
      const column = this.#columns[index] as Float32Array;
      samples.ring.copyChannel(trace.channel, view.first, column, factor, trace.lane);
      return column.subarray(0, count);
    });
    this.#plot.batch(() => {
      this.#plot.setData([view.time, ...columns], false);
      this.#plot.setScale("x", { min: view.from, max: view.to });
    });
  }

  /** Value of a trace at the cursor, or the newest one. */
  reading(index: number): number {
    const count = this.#view?.time.length ?? 0;
    const at = this.#plot.cursor.idx ?? count - 1;
    return this.#columns[index]?.[Math.min(at, count - 1)] ?? Number.NaN;
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

  #bounds(): Bound[] {
    const state = session.peek();
    return state === null ? [] : (this.choice.bounds?.(state) ?? []);
  }

  /** Over the curves shown; uPlot's own limits are no numbers where a lane has no past. */
  #range(): [number, number] {
    const count = this.#view?.time.length ?? 0;
    const shown = this.#columns.filter((_, index) => this.#plot?.series[index + 1]?.show);
    const [low, high] = extentOf(shown.map((column) => column.subarray(0, count)));
    const [bottom, top] = niceRange(low, high, this.definition.span);
    return includeBounds(
      bottom,
      top,
      this.#bounds().map((bound) => bound.value),
    );
  }

  #timeAxis(isLast: boolean): uPlot.Axis {
    return {
      ...this.#axis(),
      size: isLast ? X_AXIS_PX : 0,
      space: 60,
      incrs: TIME_STEPS_S,
      values: (_, splits) => splits.map((value) => (isLast ? text.plots.timeTick(value) : "")),
    };
  }

  #valueAxis(): uPlot.Axis {
    return {
      ...this.#axis(),
      size: Y_AXIS_PX,
      space: 22,
      values: (_, splits) => {
        const decimals = tickDecimals(splits);
        return splits.map((value) => formatNumber(Number(value.toFixed(decimals)), 12, decimals));
      },
    };
  }

  #axis(): uPlot.Axis {
    return {
      stroke: () => palette.peek().axis,
      grid: { stroke: () => palette.peek().grid, width: 1 },
      ticks: { show: false },
      font: FONT,
      gap: 4,
    };
  }
}

function tickDecimals(splits: readonly number[]): number {
  const step = Math.abs((splits[1] ?? 1) - (splits[0] ?? 0));
  for (let decimals = 0; decimals < 6; decimals++) {
    if (Math.abs(step - Number(step.toFixed(decimals))) < step * 1e-6) return decimals;
  }
  return 6;
}

function drawnTrace(trace: Trace): uPlot.Series {
  return {
    label: trace.label,
    stroke: () => palette.peek()[trace.colour],
    width: trace.width,
    points: { show: false },
    ...(trace.dash.length > 0 ? { dash: [...trace.dash] } : {}),
  };
}
