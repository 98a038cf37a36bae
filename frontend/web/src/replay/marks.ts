/** The run's events on the plots: vertical lines behind the curves, words above the first plot. */
import type uPlot from "uplot";
import { palette } from "../plots/palette";
import type { RunEvent } from "./data";

const LABEL_PX = 11;

function eventsInView(plot: uPlot, events: readonly RunEvent[]): RunEvent[] {
  const { min = 0, max = 0 } = plot.scales.x as uPlot.Scale;
  return events.filter((event) => event.time_s >= min && event.time_s <= max);
}

export function drawEvents(plot: uPlot, events: readonly RunEvent[]): void {
  const { ctx: context, bbox } = plot;
  context.save();
  context.strokeStyle = palette.peek().mark;
  context.lineWidth = devicePixelRatio;
  context.setLineDash([2 * devicePixelRatio, 3 * devicePixelRatio]);
  for (const event of eventsInView(plot, events)) {
    const x = Math.round(plot.valToPos(event.time_s, "x", true));
    context.beginPath();
    context.moveTo(x, bbox.top);
    context.lineTo(x, bbox.top + bbox.height);
    context.stroke();
  }
  context.restore();
}

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
