/** Vertical lines at what happened to a run, live and recorded: full for a load, faint for others. */
import type uPlot from "uplot";
import { palette } from "./palette";

export interface RunEvent {
  time_s: number;
  kind: string;
  label: string;
}

const FAINT = 0.5;

export const isLoad = ({ kind }: Pick<RunEvent, "kind">) =>
  kind === "load_on" || kind === "load_off";

export function eventsInView<T extends RunEvent>(plot: uPlot, events: readonly T[]): T[] {
  const { min, max } = plot.scales.x as uPlot.Scale;
  if (min === undefined || max === undefined) return [];
  return events.filter((event) => event.time_s >= min && event.time_s <= max);
}

export function drawEventLines(plot: uPlot, events: readonly RunEvent[]): void {
  const { ctx: context, bbox } = plot;
  context.save();
  context.strokeStyle = palette.peek().mark;
  context.lineWidth = devicePixelRatio;
  context.setLineDash([2 * devicePixelRatio, 3 * devicePixelRatio]);
  for (const event of eventsInView(plot, events)) {
    const x = Math.round(plot.valToPos(event.time_s, "x", true));
    context.globalAlpha = isLoad(event) ? 1 : FAINT;
    context.beginPath();
    context.moveTo(x, bbox.top);
    context.lineTo(x, bbox.top + bbox.height);
    context.stroke();
  }
  context.restore();
}
