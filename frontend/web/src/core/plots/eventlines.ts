/**
 * Events of a run in its plots: vertical lines, solid for a load, faint for others, and the sides
 * of their labels.
 */
import type uPlot from "uplot";
import { palette } from "./linestyles";

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

// Selects the marks above the plots that get a label, and its side.

export interface PlacedMark {
  x: number;
  /** Width of its label, px. */
  room: number;
  /** Priority of the label; the smallest number first. */
  rank: number;
}

type Side = "right" | "left" | null;

const HALF_MARK_PX = 6;
const OFFSET_PX = 7;
/** Distance by which a label may extend beyond the left edge. */
const OVERHANG_PX = 50;

/** A fault before a load, a load before any other change. */
export const rankOf = (kind: string): number =>
  kind === "fault" ? 0 : kind === "load_on" || kind === "load_off" ? 1 : 2;

/** marks: in the order of time; among equal priorities the newest gets its label first. */
export function nameMarks(marks: readonly PlacedMark[], width: number): Side[] {
  const taken: [number, number][] = marks.map(({ x }) => [x - HALF_MARK_PX, x + HALF_MARK_PX]);
  const isFree = (from: number, to: number) =>
    from >= -OVERHANG_PX &&
    to <= width &&
    taken.every(([left, right]) => to <= left || from >= right);
  const sides: Side[] = marks.map(() => null);
  const order = marks
    .map((mark, index) => ({ ...mark, index }))
    .sort((first, second) => first.rank - second.rank || second.index - first.index);
  for (const { x, room, index } of order) {
    const right: [number, number] = [x + OFFSET_PX, x + OFFSET_PX + room];
    const left: [number, number] = [x - OFFSET_PX - room, x - OFFSET_PX];
    const side = isFree(...right) ? "right" : isFree(...left) ? "left" : null;
    if (side === null) continue;
    taken.push(side === "right" ? right : left);
    sides[index] = side;
  }
  return sides;
}
