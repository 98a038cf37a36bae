/** Steps and time series from typed text. */
import type { Follows, Reference } from "../../core/api/design";
import type { Configuration } from "../../core/api/types";
import { parseNumber } from "../../core/readnumber";
import type { Schema, Values } from "../../core/schema";
import { findStiffness } from "../../core/state/stiffness";
import { hasDecimalComma } from "../../core/text/language";
import { t } from "../../core/text/t";
import { DEGREES_PER_RADIAN, formatInput, roundTo } from "../../core/units";

/** Kinds with their own form; any other is described by the server. */
export type Listed = "steps" | "series";
/** Levels in the unit on screen, the duration of each in s, and their number. */
type StepsValues = Readonly<Record<"low" | "high" | "hold" | "count", number>>;

const COLUMNS = { position: "position_deg", stiffness: "stiffness_nm_per_rad" } as const;

/** The forms of the kinds that the user can write as a list, in the units on screen. */
export function listSchemas(
  follows: Follows,
  configuration: Configuration,
): Record<Listed, Schema> {
  const least = findStiffness(configuration);
  const most = Math.min(2 * least, configuration.limits.stiffness_max_nm_per_rad);
  const [low, high] = follows === "position" ? [-20, 20] : [roundTo(least, 3), roundTo(most, 3)];
  const level = { type: "number", unit: follows === "position" ? "deg" : "N·m/rad" };
  const title = (name: keyof StepsValues) => t(`references.inputs.${name}`);
  const steps = {
    low: { ...level, title: title("low"), default: low },
    high: { ...level, title: title("high"), default: high },
    hold: { type: "number", title: title("hold"), unit: "s", minimum: 0, default: 2 },
    count: { type: "integer", title: title("count"), minimum: 0, maximum: 199, default: 4 },
  };
  const levels = writeLevels({ low, high, hold: steps.hold.default, count: steps.count.default });
  const csv = `time_s,${COLUMNS[follows]}\n0,${low}\n1,${high}\n3,${low}\n`;
  return {
    steps: { properties: { ...steps, levels: { default: levels } } },
    series: { properties: { csv: { default: csv } } },
  };
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
export function writeLevels(values: Values): string {
  const { low, high, hold, count } = values as StepsValues;
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
