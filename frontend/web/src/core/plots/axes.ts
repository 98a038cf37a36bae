/** The axes of every plot look the same, and stand at the same place. */
import type uPlot from "uplot";
import { palette } from "./palette";
import { formatTicks, timeStep } from "./ticks";

/** Room left and right of the curves, CSS pixels; also the place of everything laid over the plots. */
export const LEFT_PX = 50;
export const RIGHT_PX = 10;
export const FONT = "11px system-ui, sans-serif";
export const plainAxis = (): uPlot.Axis => ({
  stroke: () => palette.peek().axis,
  grid: { stroke: () => palette.peek().grid, width: 1 },
  ticks: { show: false },
  font: FONT,
  gap: 4,
});

export const valueAxis = (): uPlot.Axis => ({
  ...plainAxis(),
  size: LEFT_PX,
  space: 18,
  values: (_, splits) => formatTicks(splits),
});

/** Grid lines only: the numbers stand once below all plots. */
export const timeGrid = (): uPlot.Axis => ({
  ...plainAxis(),
  size: 0,
  space: 1,
  incrs: (_plot, _axis, from, to, width) => [timeStep({ from, to }, width)],
  values: (_, splits) => splits.map(() => ""),
});

/** An axis with numbers that is not time. */
export const otherAxis = (size: number): uPlot.Axis => ({
  ...plainAxis(),
  size,
  space: 60,
  values: (_, splits) => formatTicks(splits),
});
