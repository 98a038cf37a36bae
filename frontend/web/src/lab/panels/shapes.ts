/** Steps and time series, from what people type. */
import type { Follows, Reference } from "../../core/api/design";
import { text } from "../../core/text/en";
import { DEGREES_PER_RADIAN } from "../../core/units";

/** Those that have a form of their own; any other is described by the server. */
export type Listed = "steps" | "series";
export type Input = "low" | "high" | "hold" | "count";

/** Of steps, in the units on screen: degrees or N·m/rad, s. */
export const FIRST: Record<Follows, Record<Input, string>> = {
  position: { low: "-20", high: "20", hold: "2", count: "4" },
  stiffness: { low: "15", high: "30", hold: "2", count: "4" },
};
export const INPUTS = Object.keys(FIRST.position) as Input[];

/** The points of a polyline in a box of this size, greatest on top. */
export function drawCourse(
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

// Steps as a list: a line each, its time in s and its level in degrees or N·m/rad.

export const MAX_LEVELS = 200;
const GAP = /[\s,;]+/;

/** So many steps between two levels, at equal times; the list that these numbers stand for. */
export function writeLevels(low: number, high: number, everyS: number, count: number): string {
  const numbers = Array.from({ length: Math.max(0, Math.round(count)) + 1 }, (_, number) => number);
  const timeOf = (number: number) => Number((number * everyS).toPrecision(12));
  return numbers.map((one) => `${timeOf(one)}, ${one % 2 === 0 ? low : high}`).join("\n");
}

/** The reference of a list; throws a `RangeError` that names the line which is none. */
export function readLevels(follows: Follows, list: string): Reference {
  const rows = list.split("\n").flatMap((line, index) => {
    if (line.trim() === "") return [];
    const cells = line.trim().split(GAP).map(Number);
    if (cells.length !== 2 || !cells.every(Number.isFinite)) {
      throw new RangeError(text.references.noLevel(index + 1, line.trim()));
    }
    return [cells as [number, number]];
  });
  if (rows.length === 0 || rows.length > MAX_LEVELS) {
    throw new RangeError(text.references.levelCount(rows.length, MAX_LEVELS));
  }
  const time_s = rows.map(([time]) => time);
  const levels = rows.map(([, level]) => level);
  return follows === "position"
    ? { kind: "steps", time_s, position_rad: levels.map((level) => level / DEGREES_PER_RADIAN) }
    : { kind: "steps", time_s, stiffness_nm_per_rad: levels };
}
