/** The view of a study, as stored in its address. */
import type { StudyColumn } from "../../core/api/studies";
import { DEGREES_PER_RADIAN } from "../../core/units";
import type { Brush } from "./points";

const PLANES = ["s", "t"] as const;
export type Plane = (typeof PLANES)[number];

/** A brush, and the plane in which it was drawn. */
export interface PlaneBrush extends Brush {
  plane: Plane;
}

const formatShort = (value: number): string => String(Number(value.toPrecision(6)));

export const writeBrush = ({ plane, x, y }: PlaneBrush): string =>
  `${plane}:${[...x, ...y].map(formatShort).join(",")}`;

export function readBrush(text: string): PlaneBrush | null {
  const [plane, ends = ""] = text.split(":");
  const [left, right, bottom, top, ...rest] = ends.split(",").map(Number);
  if (plane !== "s" && plane !== "t") return null;
  if (left === undefined || right === undefined || bottom === undefined || top === undefined) {
    return null;
  }
  const isComplete = [left, right, bottom, top].every(Number.isFinite) && rest.length === 0;
  return isComplete ? { plane, x: [left, right], y: [bottom, top] } : null;
}

/** Columns that an axis can show. */
export const axesOf = (columns: readonly StudyColumn[]): StudyColumn[] =>
  columns.filter(({ name, role }) => role !== "row" || name === "law");

const FIRST_METRIC = "rms_position_error_rad";

/** Initial view of a study: the first two varied settings; the error over the first. */
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

/** Label from the server, with the unit on screen. */
export const nameColumn = ({ label, unit }: Pick<StudyColumn, "label" | "unit">): string =>
  unit === "" || unit === "1" ? label : `${label}, ${shownUnit(unit)}`;
