/** How a study's columns are called. */
import type { StudyColumn } from "../api/studies";
import { shownUnit } from "./look";

const UNIT = /(_rad_s|_nm_per_rad|_n2m2_s|_rad|_nm|_s)$/;

/** A metric in words, a setting by its path; both with what unit is known. */
export function nameColumn({ name, unit }: Pick<StudyColumn, "name" | "unit">): string {
  if (unit === "") return name.replace(/\.factor$/, " ×").replaceAll("_", " ");
  const words = name.replace(UNIT, "").replaceAll("_", " ");
  return unit === "1" ? words : `${words}, ${shownUnit(unit)}`;
}
