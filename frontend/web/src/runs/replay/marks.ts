/** The names of the run's events, above the first plot. */
import type uPlot from "uplot";
import { eventsInView, type RunEvent } from "../../core/plots/eventlines";
import { palette } from "../../core/plots/palette";

const LABEL_PX = 11;

/** Names, each where there is room left for it. */
export function drawEventLabels(plot: uPlot, events: readonly RunEvent[]): void {
  const { ctx: context, bbox } = plot;
  const gap = 4 * devicePixelRatio;
  let free = 0;
  context.save();
  context.fillStyle = palette.peek().mark;
  context.font = `600 ${LABEL_PX * devicePixelRatio}px system-ui, sans-serif`;
  context.textAlign = "left";
  context.textBaseline = "bottom";
  for (const event of eventsInView(plot, events)) {
    const width = context.measureText(event.label).width;
    const x = plot.valToPos(event.time_s, "x", true) - gap;
    const left = Math.max(bbox.left, Math.min(x, bbox.left + bbox.width - width));
    if (left < free) continue;
    free = left + width + 2 * gap;
    context.fillText(event.label, left, bbox.top - 2 * devicePixelRatio);
  }
  context.restore();
}
