/** The axes of every plot look the same, and stand at the same place. */
import type uPlot from "uplot";
import { palette } from "./palette";
import { formatTicks } from "./ticks";

/** Room left and right of the curves, CSS pixels; also the place of everything laid over the plots. */
export const LEFT_PX = 50;
export const RIGHT_PX = 10;
export const FONT = "11px system-ui, sans-serif";
/** Steps of a time axis, s. */
export const TIME_STEPS_S = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];

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
  space: 60,
  incrs: TIME_STEPS_S,
  values: (_, splits) => splits.map(() => ""),
});

/** An axis with numbers that is not time. */
export const otherAxis = (size: number): uPlot.Axis => ({
  ...plainAxis(),
  size,
  space: 60,
  values: (_, splits) => formatTicks(splits),
});
