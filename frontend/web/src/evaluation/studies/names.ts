/** How a study's columns are called. */
import type { StudyColumn } from "../../core/api/studies";
import { shownUnit } from "./look";

/** In the server's words, with the unit that it is shown in. */
export const nameColumn = ({ label, unit }: Pick<StudyColumn, "label" | "unit">): string =>
  unit === "" || unit === "1" ? label : `${label}, ${shownUnit(unit)}`;
