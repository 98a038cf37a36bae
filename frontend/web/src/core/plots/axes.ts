/** The axes of every plot: limits, ticks and style. */

import type uPlot from "uplot";
import { t } from "../text/t";
import { formatInput, formatNumber } from "../units";
import { palette } from "./linestyles";
import type { Span } from "./spans";

/** The smallest of 1, 2, 2.5, 5 × 10ⁿ that is at least `value`. */
export function niceStep(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  for (const factor of [1, 2, 2.5, 5]) {
    if (factor * power >= value * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

/**
 * Round limits around [low, high] with a margin, at least `span` wide. Without data (null, or no
 * finite number) the limits are ±span/2.
 */
export function niceRange(low: number | null, high: number | null, span: number): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) {
    return [-span / 2, span / 2];
  }
  const middle = (low + high) / 2;
  const half = Math.max((high - low) * 0.54, span / 2);
  const step = niceStep(half / 5);
  return [
    Math.floor((middle - half) / step + 1e-9) * step,
    Math.ceil((middle + half) / step - 1e-9) * step,
  ];
}

/** Extend the limits to a bound and its label if the data come near it. */
export function includeBounds(
  low: number,
  high: number,
  bounds: readonly number[],
): [number, number] {
  const reach = Math.max(Math.abs(low), Math.abs(high));
  const near = bounds.filter((bound) => reach >= bound * 0.85);
  if (near.length === 0) return [low, high];
  const outermost = Math.max(...near) * 1.25;
  return [Math.min(low, -outermost), Math.max(high, outermost)];
}

// Positions and format of the numbers of an axis.

/** Round tick values, at most about `most`. */
export function placeTicks({ from, to }: Span, most: number): number[] {
  const step = niceStep((to - from) / most);
  const first = Math.ceil(from / step - 1e-9);
  const last = Math.floor(to / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, index) => (first + index) * step);
}

function tickDecimals(splits: readonly number[]): number {
  const step = Math.abs((splits[1] ?? 1) - (splits[0] ?? 0));
  for (let decimals = 0; decimals < 6; decimals++) {
    if (Math.abs(step - Number(step.toFixed(decimals))) < step * 1e-6) return decimals;
  }
  return 6;
}

export function formatTicks(splits: readonly number[]): string[] {
  const decimals = tickDecimals(splits);
  return splits.map((value) => formatNumber(Number(value.toFixed(decimals)), 12, decimals));
}

/** Possible steps of a time axis, s. */
const TIME_STEPS_S = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20];
const LARGEST_STEP_S = 20;
/** The widest digit of the font. */
const DIGIT_PX = 7;
const BETWEEN_WORDS_PX = 16;
const MIN_BETWEEN_PX = 64;
const MIN_GAP_PX = 6;

/** Smallest step of a time axis at which its numbers do not overlap; width in CSS pixels. */
export function timeStep({ from, to }: Span, width: number): number {
  const hasRoom = (step: number) => {
    const last = Math.floor(to / step);
    const lengths = [last, last - 1].map(
      (index) => t("plots.timeTick", { seconds: Number((index * step).toFixed(4)) }).length,
    );
    const words = Math.max(MIN_BETWEEN_PX, Math.max(...lengths) * DIGIT_PX + BETWEEN_WORDS_PX);
    return (step / (to - from)) * width >= words;
  };
  return TIME_STEPS_S.find(hasRoom) ?? LARGEST_STEP_S;
}

/**
 * Left edge of a text around `x` that stays within an axis from 0 to `width`; null if it would
 * overlap the neighbours at distance `step`.
 */
export function placeWords(x: number, words: number, width: number, step: number): number | null {
  const left = Math.max(0, Math.min(x - words / 2, width - words));
  const shift = Math.abs(left + words / 2 - x);
  return shift + words + MIN_GAP_PX > step ? null : left;
}

// The axes of every plot have the same style and position.

/**
 * Margins left and right of the curves, CSS pixels; also used by everything drawn over the plots.
 */
const LEFT_PX = 50;
export const RIGHT_PX = 10;
export const FONT = "11px system-ui, sans-serif";

const plainAxis = (size: number): uPlot.Axis => ({
  size,
  stroke: () => palette.peek().axis,
  grid: { stroke: () => palette.peek().grid, width: 1 },
  ticks: { show: false },
  font: FONT,
  gap: 4,
});

/** The vertical axis of a plot. */
export const valueAxis = (): uPlot.Axis => ({
  ...plainAxis(LEFT_PX),
  space: 18,
  values: (_, splits) => formatTicks(splits),
});

/** Grid lines only: one row of numbers below all plots. */
export const timeGrid = (): uPlot.Axis => ({
  ...plainAxis(0),
  space: 1,
  incrs: (_plot, _axis, from, to, width) => [timeStep({ from, to }, width)],
  values: (_, splits) => splits.map(() => ""),
});

/** Time labels with unit; empty if there is no space. */
export const timeAxis = (size: number, tick: (timeS: number) => string): uPlot.Axis => ({
  ...plainAxis(size),
  space: 70,
  values: (_, splits) => splits.map((value) => (size > 0 ? tick(value) : "")),
});

interface Scale {
  label?: string;
  isLog?: boolean;
  /** Names instead of the numbers 0, 1, 2, … */
  labels?: readonly string[] | null;
}

const writeDecade = (value: number | null): string => (value === null ? "" : formatInput(value, 3));

/** An axis of any quantity, below a plot or to its left. */
export function otherAxis(way: "x" | "y", { label, isLog, labels }: Scale = {}): uPlot.Axis {
  return {
    ...plainAxis(way === "x" ? 26 : LEFT_PX),
    space: way === "x" ? 60 : 26,
    values: (_, splits) =>
      labels
        ? splits.map((at) => (labels[at] ?? "").slice(0, 12))
        : isLog
          ? splits.map(writeDecade)
          : formatTicks(splits),
    ...(labels && { splits: () => labels.map((_, index) => index) }),
    ...(label !== undefined && {
      label,
      labelSize: 16,
      labelGap: 0,
      labelFont: FONT,
    }),
  };
}
