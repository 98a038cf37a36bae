/** The columns of the ranking: content and sort key. */
import type { Family, Outcome, Results, Row } from "../../core/api/ranking";
import { localize } from "../../core/text/language";
import { t } from "../../core/text/t";
import { formatFixed, formatNumber, toDegrees } from "../../core/units";
import { type SortColumn, sortBy } from "../../core/widgets/tables";

const MIDDLE = 4;
const MOST = 6;
export const PEAK = "peak_position_error_rad";
export const SHARE = "peak_stiffness_error_share";
export const RECOVERY = "recovery_time_s";

export interface Column extends SortColumn {
  key:
    | "rank"
    | "familyA"
    | "familyB"
    | "p"
    | "rig"
    | "removal"
    | "mass"
    | "unmodelled"
    | "load"
    | "noise";
  /** Sort key; null comes last. */
  read: (row: Row, results: Results) => number | null;
  write: (row: Row, results: Results) => string;
  /** The run that shows it. */
  scenarioOf?: (row: Row) => string;
}

export const rankOf = (results: Results, key: string) =>
  results.ranks.find((rank) => rank.key === key);

const successOf = (family: Family | undefined): number =>
  family === undefined ? 0 : family.held / family.trials;

const writePercent = (share: number): string => formatFixed(100 * share, 1);

function writeP(value: number | null): string {
  if (value === null) return "–";
  return value < 0.001 ? `< ${formatFixed(0.001, 3)}` : localize(value.toPrecision(2));
}

/** The success rate with Wilson's interval, from the server. */
export const writeSuccess = (family: Family | undefined): string =>
  family === undefined
    ? ""
    : `${writePercent(family.success)} (${writePercent(family.success_low)}–${writePercent(family.success_high)})`;

/** The median or the 90 % quantile of a family's trials. */
export const quantileOf = (family: Family, metric: string, share: "middle" | "most") =>
  family.metrics[metric]?.[share === "middle" ? MIDDLE : MOST] ?? null;

export const writeDegrees = (value: number | null | undefined): string =>
  value === null || value === undefined ? t("ranking.fault") : formatNumber(toDegrees(value));

const outcomeOf = (row: Row, scenario: string): Outcome | undefined =>
  row.scenarios.find((outcome) => outcome.scenario === scenario);

/** Median and worst peak error, and faults, of a fixed scenario. */
export const writeOutcome = (outcome: Outcome | undefined): string => {
  if (outcome === undefined) return "";
  const pair = `${writeDegrees(outcome.median[PEAK])} / ${writeDegrees(outcome.worst_values[PEAK])}`;
  return outcome.faults > 0
    ? t("ranking.withFaults", { pair, faults: outcome.faults, runs: outcome.runs })
    : pair;
};

const fixed = (key: Column["key"], scenario: string): Column => ({
  key,
  read: (row) => outcomeOf(row, scenario)?.median[PEAK] ?? null,
  write: (row) => writeOutcome(outcomeOf(row, scenario)),
  scenarioOf: (row) => outcomeOf(row, scenario)?.worst ?? "",
});

export const COLUMNS: readonly Column[] = [
  {
    key: "rank",
    read: (row, results) => rankOf(results, row.key)?.rank ?? null,
    write: (row, results) => String(rankOf(results, row.key)?.rank ?? ""),
  },
  {
    key: "familyA",
    isDownFirst: true,
    read: (row) => successOf(row.families.A),
    write: (row) => writeSuccess(row.families.A),
  },
  {
    key: "familyB",
    isDownFirst: true,
    read: (row) => successOf(row.families.B),
    write: (row) => writeSuccess(row.families.B),
  },
  {
    key: "p",
    read: (row, results) => rankOf(results, row.key)?.p_value ?? null,
    write: (row, results) => writeP(rankOf(results, row.key)?.p_value ?? null),
  },
  fixed("rig", "rig_4a"),
  fixed("removal", "load_removal"),
  fixed("mass", "mass"),
  fixed("unmodelled", "unmodelled"),
  {
    key: "load",
    isDownFirst: true,
    read: (row) => row.largest_load_nm,
    write: (row) => String(row.largest_load_nm),
  },
  {
    key: "noise",
    read: (row) => row.noise.variation_nm_per_s,
    write: (row) =>
      row.noise.variation_nm_per_s === null
        ? t("ranking.fault")
        : formatNumber(row.noise.variation_nm_per_s),
  },
];

/** Sorted rows; those without a value come last, equal ones by rank. */
export function sortRows(results: Results | null, key: string, isDown: boolean): readonly Row[] {
  if (results === null) return [];
  const column = COLUMNS.find(({ key: columnKey }) => columnKey === key);
  if (column === undefined) return results.rows;
  return sortBy(results.rows, (row) => column.read(row, results), isDown);
}
