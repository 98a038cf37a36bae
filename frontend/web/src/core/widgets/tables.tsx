/** Parts of tables that several pages show: the best value, sortable headers, pages. */
import type { Signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { t } from "../text/t";

interface TableProps {
  /** Name of the scrolling part; left out inside a part with that name. */
  label?: string;
  caption?: ComponentChildren;
  heads: readonly ComponentChildren[];
  /** `metrics` for numbers whose names are in the first column. */
  look?: string;
  /** Class of the scrolling part. */
  class?: string;
  /** The rows. */
  children: ComponentChildren;
}

/** A table that scrolls if it is wider than its page, also by keyboard. */
export function Table({ label, caption, heads, look = "table", children, ...rest }: TableProps) {
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: scrolling needs the keyboard
    <section class={`scroll ${rest.class ?? ""}`} tabIndex={0} aria-label={label}>
      <table class={look}>
        {caption && <caption>{caption}</caption>}
        <thead>
          <tr>
            {heads.map((head, at) => (
              <th key={at} scope="col">
                {head}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>{children}</tbody>
      </table>
    </section>
  );
}

interface PagerProps {
  label: string;
  page: number;
  pages: number;
  /** The range that is shown, as text. */
  children: string;
  back: string;
  on: string;
  onTurn: (page: number) => void;
}

/** Previous and next page of a list; nothing if there is one page. */
export function Pager({ label, page, pages, children, back, on, onTurn }: PagerProps) {
  if (pages < 2) return null;
  const turn = (to: number, name: string, sign: string) => (
    <button
      type="button"
      class="button is-icon"
      aria-label={name}
      title={name}
      disabled={to < 1 || to > pages}
      onClick={() => onTurn(to)}
    >
      {sign}
    </button>
  );
  return (
    <nav class="row" aria-label={label}>
      {turn(page - 1, back, "‹")}
      <span role="status">{children}</span>
      {turn(page + 1, on, "›")}
    </nav>
  );
}

const CLEARLY = 0.95;
const NOTHING = 1e-6;

/** Index of the smallest value if it is clearly smaller than every other; otherwise -1. */
export function bestOf(values: readonly (number | null | undefined)[]): number {
  const known = values.map((value) => value ?? Number.NaN);
  const best = known.indexOf(Math.min(...known));
  if (best < 0 || !Number.isFinite(known[best])) return -1;
  const limit = Math.max(known[best] as number, NOTHING);
  const isClear = known.every((value, index) => index === best || limit < CLEARLY * value);
  return isClear ? best : -1;
}

// Header of a sortable column: another click reverses the order.

/** Rows sorted by a value, or unsorted; those without a value come last. */
export function sortBy<T>(
  rows: readonly T[],
  read: (row: T) => number | string | null,
  isDown: boolean,
): readonly T[] {
  const way = isDown ? -1 : 1;
  return [...rows].sort((first, second) => {
    const [a, b] = [read(first), read(second)];
    if (a === b) return 0;
    if (a === null) return 1;
    if (b === null) return -1;
    return (a < b ? -1 : 1) * way;
  });
}

/** An order is the name of a column, with "-" before it for descending order. */
export function nextSort(now: string, column: string, isDownFirst: boolean): string {
  if (now.replace(/^-/, "") !== column) return isDownFirst ? `-${column}` : column;
  return now.startsWith("-") ? column : `-${column}`;
}

export interface SortColumn {
  key: string;
  /** The first click sorts in descending order. */
  isDownFirst?: boolean | undefined;
  class?: string;
  width?: string | undefined;
}

interface SortHeadProps {
  column: SortColumn;
  words: { name: ComponentChildren; hint?: string | undefined };
  sort: string;
  onSort: (next: string) => void;
}

export function SortHead({ column, words, sort, onSort }: SortHeadProps) {
  const isSorted = sort.replace(/^-/, "") === column.key;
  const isDown = sort.startsWith("-");
  return (
    <th
      scope="col"
      class={column.class}
      style={{ width: column.width }}
      aria-sort={isSorted ? (isDown ? "descending" : "ascending") : "none"}
    >
      <button
        type="button"
        title={words.hint}
        onClick={() => onSort(nextSort(sort, column.key, column.isDownFirst ?? false))}
      >
        {words.name} <span aria-hidden="true">{isSorted ? (isDown ? "▼" : "▲") : ""}</span>
      </button>
    </th>
  );
}

interface SortHeadsProps<K extends string> {
  columns: readonly (SortColumn & { key: K })[];
  /** Prefix of the keys of their names and hints. */
  words: "leaderboard.columns" | "ranking.columns";
  sort: Signal<string>;
}

/** The headers of a table that is sorted in the browser. */
export function SortHeads<K extends string>({ columns, words, sort }: SortHeadsProps<K>) {
  return columns.map((column) => (
    <SortHead
      key={column.key}
      column={column}
      words={{
        name: t(`${words}.${column.key}.name` as "ranking.columns.p.name"),
        hint: t(`${words}.${column.key}.hint` as "ranking.columns.p.hint"),
      }}
      sort={sort.value}
      onSort={(next) => {
        sort.value = next;
      }}
    />
  ));
}
