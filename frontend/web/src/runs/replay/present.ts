/** The present time of the replay on a plot: a line, and the values there. */
import type uPlot from "uplot";
import type { StaticChart } from "../../core/plots/staticchart";
import { range, timeS } from "./clock";

const LINE = "now";

export function addTimeLine({ plot }: StaticChart): void {
  const line = document.createElement("div");
  line.className = LINE;
  plot.over.append(line);
  placeTimeLine(plot);
}

export function placeTimeLine(plot: uPlot): void {
  const line = plot.over.querySelector<HTMLElement>(`.${LINE}`);
  if (line === null) return;
  const { from, to } = range.peek();
  const time = timeS.peek();
  line.hidden = time < from || time > to;
  line.style.translate = `${plot.valToPos(time, "x").toFixed(2)}px`;
}

/** Value of a curve at the pointer, or else at the present time. */
export function readCurve({ plot, content }: StaticChart, values: Float32Array): number {
  const { time } = content;
  const step = (time[1] ?? 1) - (time[0] ?? 0);
  const now = Math.min(Math.round(timeS.peek() / step), time.length - 1);
  return values[plot.cursor.idx ?? now] ?? Number.NaN;
}
