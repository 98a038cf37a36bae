/** uPlot in the size of its host, without a legend; and charts without live samples. */
import { effect, type ReadonlySignal, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { niceRange, timeAxis, valueAxis } from "./axes";
import { BAND_OPACITY } from "./bands";
import type { LineStyle } from "./definitions";
import { type Palette, palette } from "./linestyles";
import type { Span } from "./spans";

const SMALLEST_DRAG_PX = 4;
/** The last two digits of a color. */
const BAND_ALPHA = Math.round(255 * BAND_OPACITY).toString(16);

/** Options of a plot without its size. */
type ChartOptions = Omit<uPlot.Options, "width" | "height">;

/** A uPlot with the size of its host element. */
export const plotIn = (host: HTMLElement, look: ChartOptions, data: uPlot.AlignedData): uPlot =>
  new uPlot(
    {
      legend: { show: false },
      cursor: { show: false },
      ...look,
      width: Math.max(1, host.clientWidth),
      height: Math.max(1, host.clientHeight),
    },
    data,
    host,
  );

/** A host without size, for example in a closed section, changes nothing. */
export function fillHost(
  plot: uPlot,
  { clientWidth: width, clientHeight: height }: HTMLElement,
): void {
  if (width > 0 && height > 0) plot.setSize({ width, height });
}

/** A chart without live samples: created again if the curves change; its owner stores them. */
export interface StaticChart {
  look: ChartOptions;
  data: uPlot.AlignedData;
  /** Called with the plot; returns its cleanup function. */
  watch?: (plot: uPlot) => () => void;
}

/** A static chart in the host whose ref is returned. */
export function useStaticChart(chart: StaticChart) {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const element = host.current;
    if (element === null) return;
    const plot = plotIn(element, chart.look, chart.data);
    // Draw now: before the first drawing the scales have no limits and values no position.
    plot.batch(() => undefined);
    const stopLook = effect(() => {
      void palette.value;
      plot.redraw(false);
    });
    const stopWatch = chart.watch?.(plot);
    const observer = new ResizeObserver(() => fillHost(plot, element));
    observer.observe(element);
    return () => {
      stopLook();
      stopWatch?.();
      observer.disconnect();
      plot.destroy();
    };
  }, [chart]);
  return host;
}

/** Not rounded to whole pixels, which would turn a slow curve into steps. */
export const drawnCurve = ({
  colour,
  width,
  dash,
}: Omit<LineStyle, "colour"> & { colour: keyof Palette }): uPlot.Series => ({
  stroke: () => palette.peek()[colour],
  width,
  dash: [...dash],
  points: { show: false },
  pxAlign: 0,
});

// Curves over time, of one or several recorded runs.

export interface StaticCurve extends LineStyle {
  key: string;
  values: uPlot.AlignedData[1];
  /** Shown and hidden together with the curve of this key. */
  follows?: string | undefined;
  /** The area up to the curve of this key is filled. */
  fillsTo?: string | undefined;
}

export interface TimeChart {
  time: uPlot.AlignedData[0];
  curves: readonly StaticCurve[];
  /** Minimum range of the axis. */
  minSpan: number;
  /** Top, right, bottom, left, CSS pixels. */
  padding: uPlot.Padding;
  /** Height of the numbers below the plot, CSS pixels, and the format of each; 0: none. */
  timeAxis: { size: number; tick: (timeS: number) => string };
  /** Plots of one group share the pointer. */
  group: string;
  /** The visible part of the time axis. */
  span: ReadonlySignal<Span>;
  hidden?: ReadonlySignal<ReadonlySet<string>> | undefined;
  /** Called when a drag selects a part of the time axis; null: a double click, the whole axis. */
  onSelect: (span: Span | null) => void;
  /** Drawn below and above the curves. */
  drawBelow?: (plot: uPlot) => void;
  drawAbove?: (plot: uPlot) => void;
  /** Called when the pointer moves; without it there are no markers. */
  onCursor?: (plot: uPlot) => void;
  watch?: (plot: uPlot) => () => void;
}

export function describeTimeChart(chart: TimeChart): StaticChart {
  const { curves, minSpan, padding, group, span, hidden, onSelect, onCursor } = chart;
  const { from: min, to: max } = span.peek();
  const look: ChartOptions = {
    padding,
    cursor: {
      y: false,
      drag: { x: true, y: false, setScale: false },
      points: onCursor ? { size: 6 } : { show: false },
      sync: { key: group, scales: ["x", null] },
      bind: {
        dblclick: () => () => {
          onSelect(null);
          return null;
        },
      },
    },
    scales: {
      x: { time: false, min, max },
      y: { range: (_, low, high) => niceRange(low, high, minSpan) },
    },
    axes: [timeAxis(chart.timeAxis.size, chart.timeAxis.tick), valueAxis()],
    series: [{}, ...curves.map(drawnCurve)],
    bands: curves.flatMap(({ fillsTo, colour }, index) => {
      const other = curves.findIndex(({ key }) => key === fillsTo);
      if (other < 0) return [];
      return { series: [index + 1, other + 1], fill: () => palette.peek()[colour] + BAND_ALPHA };
    }),
    hooks: {
      drawClear: chart.drawBelow ? [chart.drawBelow] : [],
      draw: chart.drawAbove ? [chart.drawAbove] : [],
      setCursor: onCursor ? [onCursor] : [],
      setSelect: [(plot) => select(plot, onSelect)],
    },
  };
  const watch = (plot: uPlot) => {
    const ends = [
      effect(() => plot.setScale("x", { min: span.value.from, max: span.value.to })),
      effect(() => {
        curves.forEach(({ key, follows }, index) => {
          plot.setSeries(index + 1, { show: !hidden?.value.has(follows ?? key) });
        });
      }),
      chart.watch?.(plot),
    ];
    return () => {
      for (const end of ends) end?.();
    };
  };
  return { look, data: [chart.time, ...curves.map(({ values }) => withGaps(values))], watch };
}

/** From the earliest to the latest of several ascending arrays of times. */
export const wholeOf = (times: readonly Float64Array[]): Span => ({
  from: Math.min(...times.map((time) => time[0] ?? 0)),
  to: Math.max(...times.map((time) => time[time.length - 1] ?? 1)),
});

/** The selected part of the time axis, or all of it. */
export const spanWithin = (fullSpan: Span) => {
  const span = signal(fullSpan);
  const onSelect = (chosen: Span | null) => {
    span.value = chosen ?? fullSpan;
  };
  return { span, onSelect };
};

/** NaN replaced by null, which uPlot leaves out; the same array if there is no NaN. */
function withGaps(values: StaticCurve["values"]): uPlot.AlignedData[1] {
  if (!(values instanceof Float32Array) || !values.some(Number.isNaN)) return values;
  return Array.from(values, (value) => (Number.isNaN(value) ? null : value));
}

function select(plot: uPlot, onSelect: TimeChart["onSelect"]): void {
  const { left, width } = plot.select;
  if (width === 0) return;
  plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  if (width < SMALLEST_DRAG_PX) return;
  onSelect({ from: plot.posToVal(left, "x"), to: plot.posToVal(left + width, "x") });
}
