/** Steps and time series from typed text. */
import type { Follows, Reference } from "../../core/api/design";
import type { Configuration } from "../../core/api/types";
import { type Demand, parseNumber } from "../../core/readnumber";
import { findStiffness } from "../../core/state/stiffness";
import { hasDecimalComma } from "../../core/text/language";
import { t } from "../../core/text/t";
import { DEGREES_PER_RADIAN, formatInput, roundTo } from "../../core/units";

/** Kinds with their own form; any other is described by the server. */
export type Listed = "steps" | "series";
export type Input = "low" | "high" | "hold" | "count";

export const INPUTS: readonly Input[] = ["low", "high", "hold", "count"];
export const INPUT_BOUNDS: Partial<Record<Input, Demand>> = {
  hold: { min: 0 },
  count: { min: 0, max: 199, isInteger: true },
};

/** First parameters of steps, in the units on screen: degrees or N·m/rad, s. */
export function firstSteps(follows: Follows, configuration: Configuration): Record<Input, number> {
  const timing = { hold: 2, count: 4 };
  if (follows === "position") return { low: -20, high: 20, ...timing };
  const low = findStiffness(configuration);
  const high = Math.min(2 * low, configuration.limits.stiffness_max_nm_per_rad);
  return { low: roundTo(low, 3), high: roundTo(high, 3), ...timing };
}

/** The points of a polyline in a box of this size, with the greatest value on top. */
export function coursePath(
  timeS: readonly number[],
  values: readonly number[],
  width: number,
  height: number,
): string {
  const end = timeS.at(-1) || 1;
  const low = Math.min(...values);
  const span = Math.max(...values) - low;
  const heightOf = (value: number) =>
    span === 0 ? height / 2 : height * (1 - (value - low) / span);
  return values
    .map((value, index) => {
      const x = ((timeS[index] as number) / end) * width;
      return `${x.toFixed(2)},${heightOf(value).toFixed(2)}`;
    })
    .join(" ");
}

// Steps as a list: one per line, time in s and level in degrees or N·m/rad.

export const MAX_LEVELS = 200;
/** A comma alone can be a decimal sign; before a space it separates. */
const GAP = /\s*;\s*|\s*,\s+|\s+/;

/** A list of equidistant steps between two levels. */
export function writeLevels({ low, high, hold, count }: Record<Input, number>): string {
  const numbers = Array.from({ length: count + 1 }, (_, number) => number);
  const timeOf = (number: number) => Number((number * hold).toPrecision(12));
  return numbers
    .map((number) =>
      [timeOf(number), number % 2 === 0 ? low : high]
        .map((value) => formatInput(value, 12))
        .join(hasDecimalComma ? "; " : ", "),
    )
    .join("\n");
}

/** The reference of a list; throws a `RangeError` that contains the invalid line. */
export function readLevels(follows: Follows, list: string): Reference {
  const rows = list.split("\n").flatMap((line, index) => {
    if (line.trim() === "") return [];
    const cells = line.trim().split(GAP).map(parseNumber);
    const values = cells.flatMap((cell) => ("value" in cell ? cell.value : []));
    if (cells.length !== 2 || values.length !== 2) {
      throw new RangeError(t("references.noLevel", { line: index + 1, written: line.trim() }));
    }
    return [values as [number, number]];
  });
  if (rows.length === 0 || rows.length > MAX_LEVELS) {
    throw new RangeError(t("references.levelCount", { count: rows.length, most: MAX_LEVELS }));
  }
  const time_s = rows.map(([time]) => time);
  const levels = rows.map(([, level]) => level);
  return follows === "position"
    ? { kind: "steps", time_s, position_rad: levels.map((level) => level / DEGREES_PER_RADIAN) }
    : { kind: "steps", time_s, stiffness_nm_per_rad: levels };
}
