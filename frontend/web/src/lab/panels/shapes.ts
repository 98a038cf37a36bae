/** References with a beginning and an end, from the numbers that people type. */
import type { Follows, Reference } from "../../core/api/design";
import { text } from "../../core/text/en";
import { DEGREES_PER_RADIAN } from "../../core/units";

export const SHAPES = ["steps", "minimum_jerk", "chirp", "series"] as const;
export type Shape = (typeof SHAPES)[number];
type Typed = Exclude<Shape, "series">;
export type Input =
  | "low"
  | "high"
  | "hold"
  | "count"
  | "from"
  | "to"
  | "duration"
  | "mean"
  | "amplitude"
  | "startHz"
  | "endHz";

export const INPUTS: Record<Typed, readonly Input[]> = {
  steps: ["low", "high", "hold", "count"],
  minimum_jerk: ["from", "to", "duration"],
  chirp: ["mean", "amplitude", "startHz", "endHz", "duration"],
};

/** In the units on screen: degrees or N·m/rad, s, Hz. */
export const FIRST: Record<Follows, Record<Input, string>> = {
  position: {
    low: "-20",
    high: "20",
    hold: "2",
    count: "4",
    from: "0",
    to: "40",
    duration: "5",
    mean: "0",
    amplitude: "10",
    startHz: "0.1",
    endHz: "1",
  },
  stiffness: {
    low: "15",
    high: "30",
    hold: "2",
    count: "4",
    from: "15",
    to: "60",
    duration: "5",
    mean: "30",
    amplitude: "3",
    startHz: "0.1",
    endHz: "1",
  },
};

/** Of a shape that its numbers alone make; null while a number is missing or is none. */
export function buildReference(
  follows: Follows,
  shape: Exclude<Typed, "steps">,
  typed: Record<Input, string>,
): Reference | null {
  const read = (name: Input) => (typed[name].trim() === "" ? Number.NaN : Number(typed[name]));
  if (!INPUTS[shape].every((name) => Number.isFinite(read(name)))) return null;
  const isPosition = follows === "position";
  const unit = isPosition ? "rad" : "nm_per_rad";
  const level = (name: Input) => read(name) / (isPosition ? DEGREES_PER_RADIAN : 1);
  const write = (): Record<string, unknown> => {
    switch (shape) {
      case "minimum_jerk":
        return {
          [`start_${unit}`]: level("from"),
          [`end_${unit}`]: level("to"),
          duration_s: read("duration"),
        };
      case "chirp":
        return {
          [`offset_${unit}`]: level("mean"),
          [`amplitude_${unit}`]: level("amplitude"),
          start_hz: read("startHz"),
          end_hz: read("endHz"),
          duration_s: read("duration"),
        };
    }
  };
  return { kind: shape, ...write() } as Reference;
}

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
