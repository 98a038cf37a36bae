/** Where the numbers of an axis stand, and how they are written. */
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
