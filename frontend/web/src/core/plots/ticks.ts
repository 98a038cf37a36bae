/** Where the numbers of an axis stand, and how they are written. */
import { text } from "../text/en";
import { formatNumber } from "../units";
import { niceStep } from "./range";
import type { Span } from "./spans";

/** Round places on an axis, at most about `most`. */
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

/** Steps of a time axis, s. */
const TIME_STEPS_S = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20];
const LARGEST_STEP_S = 20;
/** No digit of the font is wider. */
const DIGIT_PX = 7;
const BETWEEN_WORDS_PX = 16;
const MIN_BETWEEN_PX = 64;
const MIN_GAP_PX = 6;

/** The step of a time axis so wide, CSS pixels, on which its numbers have room beside each other. */
export function timeStep({ from, to }: Span, width: number): number {
  const hasRoom = (step: number) => {
    const last = Math.floor(to / step);
    const lengths = [last, last - 1].map((index) => text.plots.timeTick(index * step).length);
    const words = Math.max(MIN_BETWEEN_PX, Math.max(...lengths) * DIGIT_PX + BETWEEN_WORDS_PX);
    return (step / (to - from)) * width >= words;
  };
  return TIME_STEPS_S.find(hasRoom) ?? LARGEST_STEP_S;
}

/**
 * Where words about `x` begin that stay on an axis from 0 to `width`; null where they would come
 * too near to the next ones, `step` away.
 */
export function placeWords(x: number, words: number, width: number, step: number): number | null {
  const left = Math.max(0, Math.min(x - words / 2, width - words));
  const shift = Math.abs(left + words / 2 - x);
  return shift + words + MIN_GAP_PX > step ? null : left;
}
