/** One uPlot of an overlay: curves with times of their own, a line where their window begins. */
import uPlot from "uplot";
import { plainAxis, valueAxis } from "../plots/axes";
import { palette } from "../plots/palette";
import { niceRange } from "../plots/range";
import { text } from "../text/en";
import type { Overlaid, OverlayChannel } from "./overlaid";

const SMALLEST_DRAG_PX = 4;
const SPANS: Record<OverlayChannel, number> = {
  position_error_rad: 0.004,
  stiffness_error_nm_per_rad: 0.001,
};

export class OverlayChart {
  readonly #plot: uPlot;

  constructor(host: HTMLElement, curves: readonly Overlaid[], channel: OverlayChannel) {
    const tables = curves.map(
      (curve): uPlot.AlignedData => [Array.from(curve.time), curve.values[channel]],
    );
    this.#plot = new uPlot(
      {
        width: Math.max(1, host.clientWidth),
        height: Math.max(1, host.clientHeight),
        padding: [8, 14, 0, 0],
        legend: { show: false },
        cursor: {
          y: false,
          points: { show: false },
          drag: { x: true, y: false, dist: SMALLEST_DRAG_PX },
          sync: { key: "overlay", scales: ["x", null] },
        },
        scales: {
          x: { time: false },
          y: { range: (_, low, high) => niceRange(low, high, SPANS[channel]) },
        },
        axes: [
          {
            ...plainAxis(),
            size: 26,
            space: 70,
            values: (_, splits) => splits.map(text.overlay.timeTick),
          },
          valueAxis(),
        ],
        series: [{}, ...curves.map(drawn)],
        hooks: { drawClear: [(plot) => drawEdges(plot, curves)], setScale: [followTime] },
      },
      uPlot.join(tables),
      host,
    );
    uPlot.sync("overlay").sub(this.#plot);
  }

  show(index: number, isShown: boolean): void {
    this.#plot.setSeries(index + 1, { show: isShown });
  }

  resize(width: number, height: number): void {
    if (width > 0 && height > 0) this.#plot.setSize({ width, height });
  }

  redraw(): void {
    this.#plot.redraw(false);
  }

  destroy(): void {
    uPlot.sync("overlay").unsub(this.#plot);
    this.#plot.destroy();
  }
}

/** All charts of an overlay show the same stretch of time. */
function followTime(plot: uPlot, scale: string): void {
  if (scale !== "x") return;
  const { min, max } = plot.scales.x as uPlot.Scale;
  if (min == null || max == null) return;
  for (const other of uPlot.sync("overlay").plots) {
    const { x } = other.scales;
    if (other !== plot && (x?.min !== min || x?.max !== max)) other.setScale("x", { min, max });
  }
}

/** Where the windows of the numbers begin, and in its colour where that of a curve ends. */
function drawEdges(plot: uPlot, curves: readonly Overlaid[]): void {
  drawEdge(plot, 0, palette.peek().mark);
  curves.forEach(({ changedS, ink }, index) => {
    const isShown = plot.series[index + 1]?.show === true;
    if (changedS !== null && isShown) drawEdge(plot, changedS, palette.peek()[ink.colour]);
  });
}

function drawEdge(plot: uPlot, timeS: number, colour: string): void {
  const { ctx: context, bbox } = plot;
  const { min = 0, max = 0 } = plot.scales.x as uPlot.Scale;
  if (min > timeS || max < timeS) return;
  const x = Math.round(plot.valToPos(timeS, "x", true));
  context.save();
  context.strokeStyle = colour;
  context.lineWidth = devicePixelRatio;
  context.setLineDash([2 * devicePixelRatio, 3 * devicePixelRatio]);
  context.beginPath();
  context.moveTo(x, bbox.top);
  context.lineTo(x, bbox.top + bbox.height);
  context.stroke();
  context.restore();
}

function drawn(curve: Overlaid): uPlot.Series {
  return {
    stroke: () => palette.peek()[curve.ink.colour],
    width: curve.ink.width,
    dash: [...curve.ink.dash],
    points: { show: false },
    pxAlign: 0,
  };
}
