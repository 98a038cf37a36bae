/** Axis limits that are round numbers, so that a plot rests while its data move. */

/** The smallest of 1, 2, 2.5, 5 × 10ⁿ that is at least `value`. */
export function niceStep(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  for (const factor of [1, 2, 2.5, 5]) {
    if (factor * power >= value * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

/**
 * Round limits around [low, high], at least `span` wide, with a little air.
 * Without data (null, or no finite number) the limits are ±span/2.
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

/** Stretches the limits to a bound that the data come near to. */
export function includeBounds(
  low: number,
  high: number,
  bounds: readonly number[],
): [number, number] {
  const reach = Math.max(Math.abs(low), Math.abs(high));
  const near = bounds.filter((bound) => reach >= bound * 0.85);
  if (near.length === 0) return [low, high];
  const outermost = Math.max(...near) * 1.08;
  return [Math.min(low, -outermost), Math.max(high, outermost)];
}
