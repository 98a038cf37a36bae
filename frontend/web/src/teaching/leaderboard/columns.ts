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
  { key: "score", isDownFirst: true, read: ({ standing }) => standing.score },
  {
    key: "robustness",
    isDownFirst: true,
    isNumber: true,
    read: ({ standing }) => standing.parts.robustness,
  },
  {
    key: "trials",
    isDownFirst: true,
    isNumber: true,
    read: ({ standing }) => standing.parts.trials,
  },
  {
    key: "accuracy",
    isDownFirst: true,
    isNumber: true,
    read: ({ standing }) => standing.parts.accuracy,
  },
  { key: "cost", isNumber: true, read: ({ standing }) => standing.tick_us },
  { key: "worst", read: ({ standing }) => standing.worst.rms_deg ?? Number.MAX_VALUE },
  { key: "entered", isDownFirst: true, read: (entry) => entry.entered },
];

/** Place by score, 1 the best; equal scores share a place. */
export function rankEntries(entries: readonly BoardEntry[]): Ranks {
  const scores = entries.map(({ standing }) => standing.score);
  const placeOf = (score: number) => 1 + scores.filter((other) => other > score).length;
  return new Map(entries.map((one) => [one.key, placeOf(one.standing.score)]));
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
