/** The columns of the ranking: what each is of, which way is better, and which run shows it. */
import type { Outcome, Row } from "../../core/api/ranking";
import { text } from "../../core/text/en";
import { formatError } from "../../core/units";

const words = text.ranking.columns;
const STEP_NM = 0.5;
const MAX_STEP_NM = 15;

export interface Column {
  key: keyof typeof words;
  unit: string;
  isHighBetter?: boolean;
  /** Errors lie decades apart; counts, the score and torques do not. */
  isLog?: boolean;
  /** The greatest value that there can be. */
  most?: number;
  read: (row: Row) => number | null;
  /** Code of the fault that ended its run. */
  faultOf: (row: Row) => string | null;
  /** The run that shows it; null where it is of no single one. */
  scenarioOf: (row: Row) => string | null;
}

const outcomeOf = (row: Row, scenario: string): Outcome | undefined =>
  row.outcomes.find((one) => one.scenario === scenario);

const error = (key: Column["key"], scenario: string, read: Column["read"], unit = "°"): Column => ({
  key,
  unit,
  isLog: true,
  read,
  faultOf: (row) => outcomeOf(row, scenario)?.fault ?? null,
  scenarioOf: () => scenario,
});

const count = (
  key: Column["key"],
  most: number,
  read: (row: Row) => number,
  failed: (row: Row) => readonly string[],
  other: string,
): Column => ({
  key,
  unit: "",
  most,
  read,
  faultOf: () => null,
  scenarioOf: (row) => failed(row)[0] ?? other,
});

export const COLUMNS: readonly Column[] = [
  {
    key: "score",
    unit: "",
    isHighBetter: true,
    most: 1,
    read: (row) => row.score,
    faultOf: () => null,
    scenarioOf: () => null,
  },
  error("ideal", "ideal_4a", (row) => row.ideal_4a.steady_deg),
  error("rigPeak", "rig_4a", (row) => row.rig_4a.peak_deg),
  error("rigSteady", "rig_4a", (row) => row.rig_4a.steady_deg),
  error("recovery", "rig_4a", (row) => row.rig_4a.recovery_s, "s"),
  error("loadRemoval", "load_removal", (row) => row.load_removal_peak_deg),
  count(
    "loadRemovals",
    48,
    (row) => row.load_removal_faults_of_48,
    (row) => row.load_removals_failed,
    "load_removal_15_0",
  ),
  {
    ...error("rest", "", (row) => row.load_removal_steady_state_deg),
    scenarioOf: (row) => row.load_removal_worst,
  },
  error("sine", "sine_2hz", (row) => row.sine_2hz_rms_deg),
  error("mass", "mass", (row) => row.mass_rms_deg),
  error("pulses", "pulses", (row) => outcomeOf(row, "pulses")?.rms_deg ?? null),
  error("noise", "noise_5", (row) => outcomeOf(row, "noise_5")?.rms_deg ?? null),
  { ...error("trials", "trial_0", (row) => row.trials_median_deg), faultOf: () => null },
  count(
    "fails",
    100,
    (row) => row.trials_fails,
    (row) => row.trials_failed,
    "trial_0",
  ),
  {
    key: "step",
    unit: "N·m",
    isHighBetter: true,
    most: MAX_STEP_NM,
    read: (row) => row.largest_link_step_nm,
    faultOf: () => null,
    scenarioOf: (row) => `link_step_${Math.min(row.largest_link_step_nm + STEP_NM, MAX_STEP_NM)}`,
  },
];

/** Counts and steps as they are, errors as `formatError` has them. */
export const formatValue = (column: Column, value: number): string =>
  column.isLog ? formatError(value) : String(value);

/** Share of a cell's width that its bar takes: of the decades in the column, or of the most. */
export function barOf(column: Column, value: number, rows: readonly Row[]): number {
  if (!column.isLog) return Math.min(1, value / (column.most ?? 1));
  const values = rows.flatMap((row) => column.read(row) ?? []).filter((one) => one > 0);
  const least = Math.log10(Math.min(...values)) - 0.3;
  const span = Math.log10(Math.max(...values)) - least;
  return span > 0 ? Math.max(0.02, (Math.log10(Math.max(value, 1e-9)) - least) / span) : 1;
}

/** Whether a row has the best value of its column, shared or not. */
export function isBest(column: Column, row: Row, rows: readonly Row[]): boolean {
  const value = column.read(row);
  if (value === null) return false;
  const values = rows.flatMap((one) => column.read(one) ?? []);
  return value === (column.isHighBetter ? Math.max(...values) : Math.min(...values));
}

/** In the order asked for; a law without a number comes after those with one. */
export function sortRows(rows: readonly Row[], key: string, isDown: boolean): Row[] {
  const column = COLUMNS.find((one) => one.key === key);
  if (column === undefined) return [...rows];
  const worst = column.isHighBetter ? -Infinity : Infinity;
  const way = isDown ? -1 : 1;
  const size = (row: Row) => column.read(row) ?? worst;
  return [...rows].sort((one, other) => {
    const [a, b] = [size(one), size(other)];
    if (a === b) return 0;
    if (Math.abs(a) === Infinity) return 1;
    if (Math.abs(b) === Infinity) return -1;
    return way * (a - b);
  });
}

/** Which versions of the lab measured the rows: one may be renewed without the others. */
export const versionsOf = (rows: readonly Row[]) => [
  ...new Set(rows.map(({ version }) => version)),
];
