/** The columns of the leaderboard: content and sort key. */
import type { BoardEntry } from "../../core/api/ranking";
import { titleOf } from "../../core/state/laws";
import { type SortColumn, sortBy } from "../../core/widgets/tables";

export interface Column extends SortColumn {
  key: "rank" | "law" | "success" | "ended" | "rms" | "cost" | "worst" | "entered";
  read: (entry: BoardEntry) => number | string | null;
}

/** A law of the lab by its title, a submitted one by its name. */
export const nameOf = (entry: BoardEntry): string =>
  entry.is_installed ? titleOf(entry.key) : entry.name;

export const COLUMNS: readonly Column[] = [
  { key: "rank", class: "number", read: ({ rank }) => rank },
  { key: "law", class: "is-name", read: (entry) => nameOf(entry).toLocaleLowerCase() },
  { key: "success", class: "number", isDownFirst: true, read: ({ standing }) => standing.success },
  { key: "ended", class: "number", read: ({ standing }) => standing.trials_ended },
  { key: "rms", class: "number", read: ({ standing }) => standing.median_rms_deg },
  { key: "cost", class: "number", read: ({ standing }) => standing.tick_us },
  { key: "worst", read: ({ standing }) => standing.worst.rms_deg ?? Number.MAX_VALUE },
  { key: "entered", isDownFirst: true, read: (entry) => entry.entered },
];

/** Sorted entries; equal ones by rank, as the server lists them. */
export function sortEntries(entries: readonly BoardEntry[], key: string, isDown: boolean) {
  const column = COLUMNS.find(({ key: columnKey }) => columnKey === key) ?? (COLUMNS[0] as Column);
  return sortBy(entries, column.read, isDown);
}
