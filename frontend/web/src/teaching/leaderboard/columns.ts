/** The columns of the leaderboard: what each is of, and the order that it makes. */
import type { BoardEntry } from "../../core/api/ranking";
import { titleOf } from "../../core/state/laws";
import { text } from "../../core/text/en";

const words = text.leaderboard.columns;

type Ranks = ReadonlyMap<string, number>;

export interface Column {
  key: keyof typeof words;
  /** The first press brings the greatest up. */
  isDownFirst?: boolean;
  isNumber?: boolean;
  read: (entry: BoardEntry, ranks: Ranks) => number | string | null;
}

/** A law of the lab by its title, a submitted one as it was called. */
export const nameOf = (entry: BoardEntry): string =>
  entry.is_installed ? titleOf(entry.key) : entry.name;

export const COLUMNS: readonly Column[] = [
  { key: "rank", isNumber: true, read: (entry, ranks) => ranks.get(entry.key) ?? null },
  { key: "law", read: (entry) => nameOf(entry).toLocaleLowerCase() },
  { key: "success", isDownFirst: true, read: ({ standing }) => standing.success },
  { key: "ended", isNumber: true, read: ({ standing }) => standing.trials_ended },
  { key: "rms", isNumber: true, read: ({ standing }) => standing.median_rms_deg },
  { key: "cost", isNumber: true, read: ({ standing }) => standing.tick_us },
  { key: "worst", read: ({ standing }) => standing.worst.rms_deg ?? Number.MAX_VALUE },
  { key: "entered", isDownFirst: true, read: (entry) => entry.entered },
];

/** Place by success rate, 1 the best; equal rates share a place. */
export function rankEntries(entries: readonly BoardEntry[]): Ranks {
  const rates = entries.map(({ standing }) => standing.success);
  const placeOf = (rate: number) => 1 + rates.filter((other) => other > rate).length;
  return new Map(entries.map((one) => [one.key, placeOf(one.standing.success)]));
}

/** In the order asked for; what has no value comes last, what is equal stays in order of rank. */
export function sortEntries(
  entries: readonly BoardEntry[],
  ranks: Ranks,
  key: string,
  isDown: boolean,
): BoardEntry[] {
  const column = COLUMNS.find((one) => one.key === key) ?? (COLUMNS[0] as Column);
  const way = isDown ? -1 : 1;
  const rank = (entry: BoardEntry) => ranks.get(entry.key) ?? 0;
  return [...entries].sort((one, other) => {
    const [a, b] = [column.read(one, ranks), column.read(other, ranks)];
    if (a === b) return rank(one) - rank(other);
    if (a === null) return 1;
    if (b === null) return -1;
    return (a < b ? -1 : 1) * way;
  });
}
