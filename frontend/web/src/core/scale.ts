/** Position of a value on a slider with STEPS positions, linear or logarithmic. */

export const STEPS = 400;

export interface SliderRange {
  min: number;
  max: number;
  /** Logarithmic: equal distances on the slider are equal ratios of the value. */
  logarithmic?: boolean;
  /** Values at which the slider stops; any number can be typed. */
  step?: number;
}

export function positionOf(value: number, { min, max, logarithmic }: SliderRange): number {
  const held = Math.min(max, Math.max(min, value));
  const share = logarithmic
    ? Math.log(held / min) / Math.log(max / min)
    : (held - min) / (max - min);
  return Math.round(share * STEPS);
}

export function valueAt(position: number, { min, max, logarithmic, step }: SliderRange): number {
  if (position <= 0) return min;
  if (position >= STEPS) return max;
  const share = position / STEPS;
  const value = logarithmic ? min * (max / min) ** share : min + (max - min) * share;
  return step ? Number((Math.round(value / step) * step).toPrecision(12)) : value;
}
