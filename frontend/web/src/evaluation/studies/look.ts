/** What of a study is looked at, as its address says it. */
import type { StudyColumn } from "../../core/api/studies";
import { DEGREES_PER_RADIAN } from "../../core/units";
import type { Brush } from "./points";

const PLANES = ["s", "t"] as const;
export type Plane = (typeof PLANES)[number];

/** A brush, and in which of the two planes it was drawn. */
export interface Brushed extends Brush {
  plane: Plane;
}

const short = (value: number): string => String(Number(value.toPrecision(6)));

export const writeBrush = ({ plane, x, y }: Brushed): string =>
  `${plane}:${[...x, ...y].map(short).join(",")}`;

export function readBrush(text: string): Brushed | null {
  const [plane, ends = ""] = text.split(":");
  const [left, right, bottom, top, ...rest] = ends.split(",").map(Number);
  if (plane !== "s" && plane !== "t") return null;
  if (left === undefined || right === undefined || bottom === undefined || top === undefined) {
    return null;
  }
  const isWhole = [left, right, bottom, top].every(Number.isFinite) && rest.length === 0;
  return isWhole ? { plane, x: [left, right], y: [bottom, top] } : null;
}

/** Columns that may stand on an axis. */
export const axesOf = (columns: readonly StudyColumn[]): StudyColumn[] =>
  columns.filter(({ name, role }) => role !== "row" || name === "law");

const FIRST_METRIC = "rms_position_error_rad";

/** What a study is first seen by: over the first two that vary; the error over the first. */
export function chooseAxes(columns: readonly StudyColumn[]): Record<string, string> {
  const varied = columns.filter(({ role }) => role === "varied").map(({ name }) => name);
  const metrics = columns.filter(({ role }) => role === "metric").map(({ name }) => name);
  const metric = metrics.includes(FIRST_METRIC) ? FIRST_METRIC : (metrics[0] ?? "");
  const first = varied[0] ?? "law";
  return { sx: first, sy: varied[1] ?? metric, tx: first, ty: metric, metric };
}

/** rad are shown in degrees. */
export const factorOf = (unit: string): number =>
  unit === "rad" || unit === "rad·s" ? DEGREES_PER_RADIAN : 1;
export const shownUnit = (unit: string): string => unit.replace(/^rad/, "°");

/** In the server's words, with the unit that it is shown in. */
export const nameColumn = ({ label, unit }: Pick<StudyColumn, "label" | "unit">): string =>
  unit === "" || unit === "1" ? label : `${label}, ${shownUnit(unit)}`;
