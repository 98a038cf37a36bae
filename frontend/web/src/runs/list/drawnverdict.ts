/** A verdict on a plot: the tolerance band, the intervals outside it, and the largest deviation. */
import type uPlot from "uplot";
import { palette } from "../../core/plots/linestyles";
import type { OverlayCurve } from "./overlaycurves";
import type { CurveAssessment, ToleranceBand } from "./verdict";

const BAND_ALPHA = 0.16;
const STRIPE_ALPHA = 0.14;
const BAR_PX = 5;
const MIN_WIDTH_PX = 2;
const DOT_PX = 5;

function within(plot: uPlot, draw: (context: CanvasRenderingContext2D) => void): void {
  const { ctx: context, bbox } = plot;
  context.save();
  context.beginPath();
  context.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  context.clip();
  draw(context);
  context.restore();
}

/** Segments of a band with two known bounds, as indices from … to before. */
export function listKnown({ low, high }: ToleranceBand): [number, number][] {
  const known: [number, number][] = [];
  let begin = -1;
  for (let index = 0; index <= low.length; index++) {
    const isKnown = index < low.length && low[index] !== null && high[index] !== null;
    if (isKnown && begin < 0) begin = index;
    if (!isKnown && begin >= 0) {
      known.push([begin, index]);
      begin = -1;
    }
  }
  return known;
}

export function drawBands(plot: uPlot, bands: readonly ToleranceBand[]): void {
  within(plot, (context) => {
    context.fillStyle = palette.peek().mark;
    context.globalAlpha = BAND_ALPHA;
    for (const band of bands) {
      const x = (index: number) => plot.valToPos(band.time[index] as number, "x", true);
      for (const [begin, end] of listKnown(band)) {
        context.beginPath();
        for (let index = begin; index < end; index++) {
          context.lineTo(x(index), plot.valToPos(band.high[index] as number, "y", true));
        }
        for (let index = end - 1; index >= begin; index--) {
          context.lineTo(x(index), plot.valToPos(band.low[index] as number, "y", true));
        }
        context.closePath();
        context.fill();
      }
    }
  });
}

/** Vertical stripes, and one row of bars per curve at the top. */
export function drawOutside(plot: uPlot, judged: readonly CurveAssessment[]): void {
  const { top, height } = plot.bbox;
  within(plot, (context) => {
    judged.forEach(({ curve, outside }, row) => {
      context.fillStyle = palette.peek()[curve.lineStyle.colour];
      for (const [from, to] of outside) {
        const left = plot.valToPos(from, "x", true);
        const width = plot.valToPos(to, "x", true) - left;
        const drawn = Math.max(width, MIN_WIDTH_PX * devicePixelRatio);
        context.globalAlpha = STRIPE_ALPHA;
        context.fillRect(left, top, drawn, height);
        context.globalAlpha = 1;
        const bar = BAR_PX * devicePixelRatio;
        context.fillRect(left, top + row * bar, drawn, bar - devicePixelRatio);
      }
    });
  });
}

/** The point at which a failed curve is farthest outside its band. */
export function drawWorst(plot: uPlot, judged: readonly CurveAssessment[]): void {
  within(plot, (context) => {
    for (const { curve, isWithin: isHeld, worstS, value } of judged) {
      if (isHeld || value === null) continue;
      const [x, y] = [plot.valToPos(worstS, "x", true), plot.valToPos(value, "y", true)];
      context.beginPath();
      context.arc(x, y, DOT_PX * devicePixelRatio, 0, 2 * Math.PI);
      context.fillStyle = palette.peek().surface;
      context.strokeStyle = palette.peek()[curve.lineStyle.colour];
      context.lineWidth = 2 * devicePixelRatio;
      context.setLineDash([]);
      context.fill();
      context.stroke();
    }
  });
}

// Lines on an overlay at the start and end of windows.

/** Time 0, and in the color of a curve the start of its window if different, and its end. */
export function drawEdges(plot: uPlot, curves: readonly OverlayCurve[]): void {
  drawEdge(plot, 0, palette.peek().mark);
  curves.forEach(({ startS, changedS, lineStyle }, index) => {
    if (plot.series[index + 1]?.show !== true) return;
    const colour = palette.peek()[lineStyle.colour];
    if (startS !== 0) drawEdge(plot, startS, colour);
    if (changedS !== null) drawEdge(plot, changedS, colour);
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
