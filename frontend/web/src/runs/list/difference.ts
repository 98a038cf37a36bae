/** A setting that differs between runs, in the units that people read. */
import type { RunDifference } from "../../core/api/types";
import { text } from "../../core/text/en";
import { formatInput, toDegrees } from "../../core/units";

type Row = RunDifference["differences"][number];

const NONE = "–";
const IN_DEGREES: Readonly<Record<string, string>> = { rad: "deg" };

export function formatSetting({ unit, values }: Row): { unit: string; values: string[] } {
  const shown = IN_DEGREES[unit];
  const format = (value: Row["values"][number]): string => {
    if (value === null) return NONE;
    if (typeof value === "boolean") return value ? text.difference.yes : text.difference.no;
    if (typeof value === "string") return value;
    return formatInput(shown === undefined ? value : toDegrees(value), 6).replace("-", "−");
  };
  return { unit: shown ?? unit, values: values.map(format) };
}
