/**
 * Conversion between SI, used internally, and the units and number formats on screen; nowhere else.
 */

import { language, localize } from "./text/language";

export const DEGREES_PER_RADIAN = 180 / Math.PI;

export const toDegrees = (rad: number): number => rad * DEGREES_PER_RADIAN;
export const toRadians = (deg: number): number => deg / DEGREES_PER_RADIAN;

const MINUS = "\u2212";

/** Number of decimals that show `digits` significant digits, at most `most`. */
function decimalsFor(value: number, digits: number, most = 4): number {
  const size = Math.abs(value);
  if (!Number.isFinite(size) || size === 0) return Math.min(digits - 1, most);
  const decimals = digits - 1 - Math.floor(Math.log10(size));
  return Math.max(0, Math.min(most, decimals));
}

/** `digits` significant digits, never in exponent form, with a typographic minus sign. */
export function formatNumber(value: number | null | undefined, digits = 3, most = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "\u2013";
  const text = value.toFixed(decimalsFor(value, digits, most));
  const unsigned = text.replace("-", "");
  return localize(text.startsWith("-") && Number(unsigned) !== 0 ? MINUS + unsigned : unsigned);
}

/** A value with the half width of its interval, of which one digit is significant: 41.2 ± 0.4. */
export function formatInterval(value: number, half: number): string {
  const decimals = decimalsFor(half, 1);
  return `${formatFixed(value, decimals)} ± ${formatFixed(half, decimals)}`;
}

/** As many decimals as given, with an ASCII minus sign. */
export const formatFixed = (value: number, decimals: number): string =>
  localize(value.toFixed(decimals));

/** A whole number with separators of thousands. */
export const formatCount = (value: number): string => Math.round(value).toLocaleString(language);

const SMALL = 1e-3;

/**
 * An error with four decimals; a smaller one with two digits, so that none reads as zero or as
 * another.
 */
export function formatError(value: number | null | undefined, digits = 3): string {
  const isSmall = value !== null && value !== undefined && Math.abs(value) < SMALL;
  return isSmall ? formatNumber(value, 2, 6) : formatNumber(value, digits, 4);
}

/** `digits` significant digits. */
export const roundTo = (value: number, digits: number): number => Number(value.toPrecision(digits));

/**
 * A number for an input field: short, with an ASCII minus sign, without relevant loss of precision.
 */
export function formatInput(value: number, digits = 5): string {
  return localize(String(roundTo(value, digits)));
}

/** A short duration in a suitable unit: 25 µs, 1.3 ms, 2.40 s. */
export function formatLapse(seconds: number): string {
  const size = Math.abs(seconds);
  if (size < 0.9995e-3) return `${formatNumber(seconds * 1e6, 2, 0)} µs`;
  if (size < 0.9995) return `${formatNumber(seconds * 1e3, 2, 1)} ms`;
  return `${formatNumber(seconds, 3, 2)} s`;
}

/** A duration as minutes and whole seconds: 75.25 is 1:15. */
export function formatSeconds(seconds: number): string {
  const wholeSeconds = Math.floor(Math.max(0, seconds) + 1e-6);
  return `${Math.floor(wholeSeconds / 60)}:${String(wholeSeconds % 60).padStart(2, "0")}`;
}

/** Session time as minutes and seconds: 75.25 is 1:15.2. */
export function formatTime(seconds: number): string {
  const tenths = Math.floor(Math.max(0, seconds) * 10 + 1e-6);
  const minutes = Math.floor(tenths / 600);
  const rest = (tenths % 600) / 10;
  return `${minutes}:${formatFixed(rest, 1).padStart(4, "0")}`;
}
