/** What is drawn behind and above the curves: events as vertical lines, bounds as faint ones. */
import type uPlot from "uplot";
import type { SessionEvent } from "../api/types";
import { session } from "../state/session";
import type { Bound } from "./definitions";
import { palette } from "./palette";

const LABEL_PX = 11;

const isLoad = (event: SessionEvent) => event.kind === "load_on" || event.kind === "load_off";

function eventsInView(plot: uPlot): SessionEvent[] {
  const { min, max } = plot.scales.x as uPlot.Scale;
  if (min === undefined || max === undefined) return [];
  const events = session.peek()?.events ?? [];
  return events.filter((event) => event.time_s >= min && event.time_s <= max);
}

function strokeLine(
  context: CanvasRenderingContext2D,
  from: [number, number],
  to: [number, number],
): void {
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
}

/** Vertical lines at the events in view. */
export function drawEvents(plot: uPlot): void {
  const { ctx: context, bbox } = plot;
  context.save();
  context.strokeStyle = palette.peek().mark;
  context.lineWidth = devicePixelRatio;
  context.setLineDash([2 * devicePixelRatio, 3 * devicePixelRatio]);
  for (const event of eventsInView(plot)) {
    const x = Math.round(plot.valToPos(event.time_s, "x", true));
    context.globalAlpha = isLoad(event) ? 1 : 0.5;
    strokeLine(context, [x, bbox.top], [x, bbox.top + bbox.height]);
  }
  context.restore();
}

/** The names of the events above the plot; where two want one place, a load wins, then the newer. */
export function drawEventLabels(plot: uPlot): void {
  const { ctx: context, bbox } = plot;
  const gap = 4 * devicePixelRatio;
  const taken: [number, number][] = [];
  context.save();
  context.fillStyle = palette.peek().mark;
  context.font = `600 ${LABEL_PX * devicePixelRatio}px system-ui, sans-serif`;
  context.textAlign = "left";
  context.textBaseline = "bottom";
  const newestFirst = eventsInView(plot).reverse();
  const loadsFirst = [...newestFirst.filter(isLoad), ...newestFirst.filter((e) => !isLoad(e))];
  for (const event of loadsFirst) {
    const width = context.measureText(event.label).width;
    const x = plot.valToPos(event.time_s, "x", true) - gap;
    const left = Math.max(bbox.left, Math.min(x, bbox.left + bbox.width - width));
    const right = left + width + 2 * gap;
    if (taken.some(([from, to]) => left < to && from < right)) continue;
    taken.push([left, right]);
    context.fillText(event.label, left, bbox.top - 2 * devicePixelRatio);
  }
  context.restore();
}

/** Faint lines at ±value of each bound that is on the axis. */
export function drawBounds(plot: uPlot, bounds: readonly Bound[]): void {
  const { min, max } = plot.scales.y as uPlot.Scale;
  if (min === undefined || max === undefined) return;
  const { ctx: context, bbox } = plot;
  context.save();
  context.setLineDash([]);
  context.lineWidth = devicePixelRatio;
  context.font = `${LABEL_PX * devicePixelRatio}px system-ui, sans-serif`;
  context.textBaseline = "middle";
  context.textAlign = "left";
  context.fillStyle = palette.peek().axis;
  for (const bound of bounds) {
    context.strokeStyle = palette.peek()[bound.colour];
    const gap = context.measureText(bound.label).width + 8 * devicePixelRatio;
    for (const value of [-bound.value, bound.value]) {
      if (value < min || value > max) continue;
      const y = Math.round(plot.valToPos(value, "y", true));
      context.globalAlpha = 0.6;
      strokeLine(context, [bbox.left, y], [bbox.left + bbox.width - gap, y]);
      context.globalAlpha = 1;
      context.fillText(bound.label, bbox.left + bbox.width - gap + 4 * devicePixelRatio, y);
    }
  }
  context.restore();
}
