/** Lines on an overlay where windows begin and end. */
import type uPlot from "uplot";
import { palette } from "../../core/plots/palette";
import type { Overlaid } from "./overlaid";

/** Time 0, and in its colour where the window of a curve's numbers begins otherwise, and ends. */
export function drawEdges(plot: uPlot, curves: readonly Overlaid[]): void {
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
