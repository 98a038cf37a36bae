const CLEARLY = 0.95;
const NOTHING = 1e-6;

/** Index of the smallest value where it is clearly smaller than every other; else -1. */
export function bestOf(values: readonly (number | null | undefined)[]): number {
  const known = values.map((value) => value ?? Number.NaN);
  const best = known.indexOf(Math.min(...known));
  if (best < 0 || !Number.isFinite(known[best])) return -1;
  const limit = Math.max(known[best] as number, NOTHING);
  const isClear = known.every((value, index) => index === best || limit < CLEARLY * value);
  return isClear ? best : -1;
}
