/** Parts of tables that several pages show: the best value, heads that sort, pages. */
import type { ComponentChildren } from "preact";

interface TableProps {
  /** Names the part that scrolls; left out where it stands in one with that name. */
  label?: string;
  caption?: ComponentChildren;
  heads: readonly ComponentChildren[];
  /** `metrics` for numbers whose names are in the first column. */
  look?: string;
  /** Of the part that scrolls. */
  class?: string;
  /** Its rows. */
  children: ComponentChildren;
}

/** A table that scrolls where it is wider than its page, also by keyboard. */
export function Table({ label, caption, heads, look = "table", children, ...rest }: TableProps) {
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls is reached by keyboard
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
  /** Which part is shown, in words. */
  children: string;
  back: string;
  on: string;
  onTurn: (page: number) => void;
}

/** Turns the pages of a list; nothing where there is one. */
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

/** Index of the smallest value where it is clearly smaller than every other; else -1. */
export function bestOf(values: readonly (number | null | undefined)[]): number {
  const known = values.map((value) => value ?? Number.NaN);
  const best = known.indexOf(Math.min(...known));
  if (best < 0 || !Number.isFinite(known[best])) return -1;
  const limit = Math.max(known[best] as number, NOTHING);
  const isClear = known.every((value, index) => index === best || limit < CLEARLY * value);
  return isClear ? best : -1;
}

// The head of a column that a table can be ordered by: pressed again it orders the other way.

/** An order is the name of a column, with "-" before it where the greatest is first. */
export function nextSort(now: string, column: string, isDownFirst: boolean): string {
  if (now.replace(/^-/, "") !== column) return isDownFirst ? `-${column}` : column;
  return now.startsWith("-") ? column : `-${column}`;
}

interface SortHeadProps {
  column: string;
  sort: string;
  hint: string | undefined;
  isDownFirst: boolean | undefined;
  onSort: (next: string) => void;
  class?: string;
  children: ComponentChildren;
}

export function SortHead({ column, sort, hint, isDownFirst, onSort, ...rest }: SortHeadProps) {
  const isSorted = sort.replace(/^-/, "") === column;
  const isDown = sort.startsWith("-");
  return (
    <th
      scope="col"
      class={rest.class}
      aria-sort={isSorted ? (isDown ? "descending" : "ascending") : "none"}
    >
      <button
        type="button"
        title={hint}
        onClick={() => onSort(nextSort(sort, column, isDownFirst ?? false))}
      >
        {rest.children}
        <span class="sort-sign" aria-hidden="true">
          {isSorted ? (isDown ? "▼" : "▲") : ""}
        </span>
      </button>
    </th>
  );
}
