/** A plane with two axes: a drag selects an area, a click selects a dot. */
import type uPlot from "uplot";
import { otherAxis } from "../../core/plots/axes";
import type { StaticChart } from "../../core/plots/staticchart";
import type { Brush, Span } from "./points";

export interface Axis {
  label: string;
  span: Span;
  isLog: boolean;
  labels: readonly string[] | null;
}

interface Plane {
  x: Axis;
  y: Axis;
  paint: (plot: uPlot) => void;
  onBrush: (brush: Brush) => void;
  onPick: (plot: uPlot, left: number, top: number) => void;
  watch: (plot: uPlot) => () => void;
}

const SMALLEST_DRAG_PX = 5;
const CLICK_PX = 3;

export function describePlane({ x, y, paint, onBrush, onPick, watch }: Plane): StaticChart {
  const look: StaticChart["look"] = {
    padding: [8, 12, 0, 0],
    cursor: {
      points: { show: false },
      drag: { x: true, y: true, setScale: false, dist: SMALLEST_DRAG_PX },
    },
    scales: {
      x: { time: false, distr: x.isLog ? 3 : 1, range: () => [...x.span] },
      y: { distr: y.isLog ? 3 : 1, range: () => [...y.span] },
    },
    axes: [otherAxis("x", x), otherAxis("y", y)],
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
  };
  const listen = (plot: uPlot) => {
    let pressed: readonly [number, number] = [Infinity, Infinity];
    plot.over.addEventListener("mousedown", ({ clientX, clientY }) => {
      pressed = [clientX, clientY];
    });
    plot.over.addEventListener("mouseup", ({ clientX, clientY }) => {
      if (Math.hypot(clientX - pressed[0], clientY - pressed[1]) > CLICK_PX) return;
      const box = plot.over.getBoundingClientRect();
      onPick(plot, clientX - box.left, clientY - box.top);
    });
    return watch(plot);
  };
  return { look, data: [[...x.span], [...y.span]], watch: listen };
}

/** The current brush, which other parts may also set. */
export function showBrush(plot: uPlot, brush: Brush | null): void {
  const [left, right] = (brush?.x ?? []).map((at) => plot.valToPos(at, "x"));
  const [bottom, top] = (brush?.y ?? []).map((at) => plot.valToPos(at, "y"));
  const select =
    left === undefined || right === undefined || top === undefined || bottom === undefined
      ? { left: 0, top: 0, width: 0, height: 0 }
      : { left, top, width: right - left, height: bottom - top };
  plot.setSelect(select, false);
  plot.redraw(false);
}
