/** The head of a column that a table can be ordered by: pressed again it orders the other way. */
import type { ComponentChildren } from "preact";

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
