/** uPlot as the page uses it: in the size of its host, without a legend; and charts that stand still. */
import { effect, type ReadonlySignal, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { niceRange, timeAxis, valueAxis } from "./axes";
import type { LineStyle } from "./definitions";
import { type Palette, palette } from "./linestyles";
import type { Span } from "./spans";

const SMALLEST_DRAG_PX = 4;

/** The options of a plot without its size. */
type Look = Omit<uPlot.Options, "width" | "height">;

/** A uPlot as large as its host is. */
export const plotIn = (host: HTMLElement, look: Look, data: uPlot.AlignedData): uPlot =>
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

/** A host without room, as of what is folded, changes nothing. */
export function fillHost(
  plot: uPlot,
  { clientWidth: width, clientHeight: height }: HTMLElement,
): void {
  if (width > 0 && height > 0) plot.setSize({ width, height });
}

/** A chart without live samples: created again for other curves, which its owner stores. */
export interface StillChart {
  look: Look;
  data: uPlot.AlignedData;
  /** Called with the plot; returns what ends it. */
  watch?: (plot: uPlot) => () => void;
}

/** A static chart in the host whose ref is returned. */
export function useStillChart(chart: StillChart) {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const element = host.current;
    if (element === null) return;
    const plot = plotIn(element, chart.look, chart.data);
    // Draws it now: before, its scales have no limits, and no value a place.
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

/** Not moved to whole pixels, which would turn a slow curve into steps. */
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

// Curves over time, of a recorded run, or of several over one another.

export interface StillCurve extends LineStyle {
  key: string;
  values: uPlot.AlignedData[1];
  /** Drawn and hidden together with the curve of this key. */
  follows?: string | undefined;
}

export interface TimeChart {
  time: uPlot.AlignedData[0];
  curves: readonly StillCurve[];
  /** The axis never shows less than this. */
  minSpan: number;
  /** Top, right, bottom, left, CSS pixels. */
  padding: uPlot.Padding;
  /** Height of the numbers below the plot, CSS pixels, and the words of each; 0: none. */
  timeAxis: { size: number; tick: (timeS: number) => string };
  /** The plots of one group have one pointer. */
  group: string;
  /** What part of the time is shown. */
  span: ReadonlySignal<Span>;
  hidden?: ReadonlySignal<ReadonlySet<string>> | undefined;
  /** A drag over the plot has chosen a part of the time; null: a double click, all of it. */
  onSelect: (span: Span | null) => void;
  /** Below the curves, and above them. */
  drawBelow?: (plot: uPlot) => void;
  drawAbove?: (plot: uPlot) => void;
  /** The pointer has moved; without a reader of the values there are no marks. */
  onCursor?: (plot: uPlot) => void;
  watch?: (plot: uPlot) => () => void;
}

export function describeTimeChart(chart: TimeChart): StillChart {
  const { curves, minSpan, padding, group, span, hidden, onSelect, onCursor } = chart;
  const { from: min, to: max } = span.peek();
  const look: Look = {
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

/** From the earliest to the latest of times that are in order each. */
export const wholeOf = (times: readonly Float64Array[]): Span => ({
  from: Math.min(...times.map((time) => time[0] ?? 0)),
  to: Math.max(...times.map((time) => time[time.length - 1] ?? 1)),
});

/** A part of the time that was chosen, or the whole of it. */
export const spanWithin = (whole: Span) => {
  const span = signal(whole);
  const onSelect = (chosen: Span | null) => {
    span.value = chosen ?? whole;
  };
  return { span, onSelect };
};

/** Values with null, which uPlot leaves out, for NaN; the same array where there is none. */
function withGaps(values: StillCurve["values"]): uPlot.AlignedData[1] {
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
