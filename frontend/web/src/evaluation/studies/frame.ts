/** A plane with two axes on which somebody paints: drag brushes, a click picks. */
import uPlot from "uplot";
import { otherAxis, plainAxis } from "../../core/plots/axes";
import type { Brush, Span } from "./points";

export interface Axis {
  label: string;
  span: Span;
  isLog: boolean;
  labels: readonly string[] | null;
}

interface Wanted {
  x: Axis;
  y: Axis;
  paint: (plot: uPlot) => void;
  onBrush: (brush: Brush | null) => void;
  onPick: (plot: uPlot, left: number, top: number) => void;
}

const SMALLEST_DRAG_PX = 5;
const CLICK_PX = 3;
const BETWEEN_NUMBERS = { x: 60, y: 26 };
const SIZES = { x: 26, y: 50 };

const writeDecade = (value: number | null): string =>
  value === null ? "" : String(Number(value.toPrecision(3)));

function axisOf(axis: Axis, way: "x" | "y"): uPlot.Axis {
  const { labels, isLog } = axis;
  const named: Partial<uPlot.Axis> =
    labels === null
      ? isLog
        ? { values: (_, splits) => splits.map(writeDecade) }
        : {}
      : {
          splits: () => labels.map((_, index) => index),
          values: (_, splits) => splits.map((at) => (labels[at] ?? "").slice(0, 12)),
        };
  return {
    ...(isLog ? plainAxis() : otherAxis(SIZES[way])),
    size: SIZES[way],
    space: BETWEEN_NUMBERS[way],
    label: axis.label,
    labelSize: 16,
    labelGap: 0,
    labelFont: "12px system-ui, sans-serif",
    ...named,
  };
}

export class PlotFrame {
  readonly #plot: uPlot;

  constructor(host: HTMLElement, { x, y, paint, onBrush, onPick }: Wanted) {
    let pressed: readonly [number, number] | null = null;
    this.#plot = new uPlot(
      {
        width: Math.max(1, host.clientWidth),
        height: Math.max(1, host.clientHeight),
        padding: [8, 12, 0, 0],
        legend: { show: false },
        cursor: {
          points: { show: false },
          drag: { x: true, y: true, setScale: false, dist: SMALLEST_DRAG_PX },
        },
        scales: {
          x: { time: false, distr: x.isLog ? 3 : 1, range: () => [...x.span] },
          y: { distr: y.isLog ? 3 : 1, range: () => [...y.span] },
        },
        axes: [axisOf(x, "x"), axisOf(y, "y")],
        series: [{}, { show: false }],
        hooks: {
          draw: [paint],
          setSelect: [
            (plot) => {
              const { left, top, width, height } = plot.select;
              if (width < SMALLEST_DRAG_PX || height < SMALLEST_DRAG_PX) return;
              onBrush({
                x: [plot.posToVal(left, "x"), plot.posToVal(left + width, "x")],
                y: [plot.posToVal(top + height, "y"), plot.posToVal(top, "y")],
              });
            },
          ],
        },
      },
      [[...x.span], [...y.span]],
      host,
    );
    this.#plot.over.addEventListener("mousedown", ({ clientX, clientY }) => {
      pressed = [clientX, clientY];
    });
    this.#plot.over.addEventListener("mouseup", ({ clientX, clientY }) => {
      const [left, top] = pressed ?? [Infinity, Infinity];
      if (Math.hypot(clientX - left, clientY - top) > CLICK_PX) return;
      const box = this.#plot.over.getBoundingClientRect();
      onPick(this.#plot, clientX - box.left, clientY - box.top);
    });
  }

  /** The brush as it is now, which may have been set elsewhere. */
  show(brush: Brush | null): void {
    const plot = this.#plot;
    if (brush === null) {
      plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    } else {
      const [left, right] = brush.x.map((at) => plot.valToPos(at, "x")) as [number, number];
      const [bottom, top] = brush.y.map((at) => plot.valToPos(at, "y")) as [number, number];
      plot.setSelect({ left, top, width: right - left, height: bottom - top }, false);
    }
    plot.redraw(false);
  }

  resize(width: number, height: number): void {
    if (width > 0 && height > 0) this.#plot.setSize({ width, height });
  }

  destroy(): void {
    this.#plot.destroy();
  }
}
