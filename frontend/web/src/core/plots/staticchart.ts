/** A plot of curves that stand still: of a recorded run, or of several over one another. */
import { effect, type ReadonlySignal, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { niceRange, plainAxis, valueAxis } from "./axes";
import type { LineStyle } from "./definitions";
import { palette } from "./linestyles";
import type { Span } from "./spans";

const SMALLEST_DRAG_PX = 4;

export interface StaticCurve extends LineStyle {
  key: string;
  values: uPlot.AlignedData[1];
  /** Drawn and hidden together with the curve of this key. */
  follows?: string;
}

export interface StaticContent {
  time: uPlot.AlignedData[0];
  curves: readonly StaticCurve[];
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
  /** A drag over the plot has chosen a part of the time; null: a double click, all of it. */
  onSelect: (span: Span | null) => void;
  /** Below the curves, and above them. */
  drawBelow: (plot: uPlot) => void;
  drawAbove?: (plot: uPlot) => void;
  /** The pointer has moved; where nobody reads the values there, they have no marks. */
  onCursor?: () => void;
}

export class StaticChart {
  readonly plot: uPlot;

  constructor(
    host: HTMLElement,
    readonly content: StaticContent,
  ) {
    const { time, curves, minSpan, padding, group, span, onSelect } = content;
    const { drawBelow, drawAbove, onCursor } = content;
    const { from, to } = span.peek();
    this.plot = new uPlot(
      {
        width: Math.max(1, host.clientWidth),
        height: Math.max(1, host.clientHeight),
        padding,
        legend: { show: false },
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
          x: { time: false, min: from, max: to },
          y: { range: (_, low, high) => niceRange(low, high, minSpan) },
        },
        axes: [timeAxis(content.timeAxis), valueAxis()],
        series: [{}, ...curves.map(drawnCurve)],
        hooks: {
          drawClear: [drawBelow],
          draw: drawAbove ? [drawAbove] : [],
          setCursor: onCursor ? [onCursor] : [],
          setSelect: [(plot) => select(plot, onSelect)],
        },
      },
      [time, ...curves.map(({ values }) => withGaps(values))],
      host,
    );
    this.showSpan();
  }

  showSpan(): void {
    const { from: min, to: max } = this.content.span.peek();
    this.plot.setScale("x", { min, max });
  }

  hide(hidden: ReadonlySet<string>): void {
    this.content.curves.forEach(({ key, follows }, index) => {
      this.plot.setSeries(index + 1, { show: !hidden.has(follows ?? key) });
    });
  }

  resize(width: number, height: number): void {
    if (width > 0 && height > 0) this.plot.setSize({ width, height });
  }
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
function withGaps(values: StaticCurve["values"]): uPlot.AlignedData[1] {
  if (!(values instanceof Float32Array) || !values.some(Number.isNaN)) return values;
  return Array.from(values, (value) => (Number.isNaN(value) ? null : value));
}

function select(plot: uPlot, onSelect: StaticContent["onSelect"]): void {
  const { left, width } = plot.select;
  if (width === 0) return;
  plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  if (width < SMALLEST_DRAG_PX) return;
  onSelect({ from: plot.posToVal(left, "x"), to: plot.posToVal(left + width, "x") });
}

const timeAxis = ({ size, tick }: StaticContent["timeAxis"]): uPlot.Axis => ({
  ...plainAxis(),
  size,
  space: 70,
  values: (_, splits) => splits.map((value) => (size > 0 ? tick(value) : "")),
});

/** Not moved to whole pixels, which would turn a slow curve into steps. */
function drawnCurve(curve: StaticCurve): uPlot.Series {
  return {
    stroke: () => palette.peek()[curve.colour],
    width: curve.width,
    dash: [...curve.dash],
    points: { show: false },
    pxAlign: 0,
  };
}

/**
 * A static chart in the host whose ref is returned: made anew for another content, which its owner
 * keeps; `watch` is called with each and returns what ends it.
 */
export function useStaticChart(
  content: StaticContent,
  hidden: ReadonlySet<string>,
  watch?: (chart: StaticChart) => () => void,
) {
  const host = useRef<HTMLDivElement>(null);
  const chart = useRef<StaticChart | null>(null);
  useEffect(() => {
    const element = host.current;
    if (element === null) return;
    const made = new StaticChart(element, content);
    chart.current = made;
    const ends = [
      effect(() => {
        void content.span.value;
        made.showSpan();
      }),
      effect(() => {
        void palette.value;
        made.plot.redraw(false);
      }),
      ...(watch ? [watch(made)] : []),
    ];
    const observer = new ResizeObserver(() => {
      made.resize(element.clientWidth, element.clientHeight);
    });
    observer.observe(element);
    return () => {
      for (const end of ends) end();
      observer.disconnect();
      made.plot.destroy();
      chart.current = null;
    };
  }, [content]);
  useEffect(() => chart.current?.hide(hidden), [content, hidden]);
  return host;
}
