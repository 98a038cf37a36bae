import type { RunSummary } from "../api/types";
import { text } from "../text/en";
import { COLUMNS, type Column, NAME_SORT } from "./columns";
import { ask, sort } from "./list";
import { RunRow } from "./row";

const words = text.runs;

/** The next press on a column: its own way first, then the other way round. */
export function nextSort(now: string, column: string, isDownFirst: boolean): string {
  if (now.replace(/^-/, "") !== column) return isDownFirst ? `-${column}` : column;
  return now.startsWith("-") ? column : `-${column}`;
}

interface HeadProps extends Pick<Column, "name" | "hint" | "sort" | "isDownFirst" | "isNumber"> {
  class: string;
}

function Head({ name, hint, sort: column, isDownFirst = false, isNumber, ...rest }: HeadProps) {
  const isSorted = sort.value.replace(/^-/, "") === column;
  const isDown = sort.value.startsWith("-");
  const look = `${rest.class} ${isNumber ? "is-number" : ""}`;
  if (column === undefined) {
    return (
      <th scope="col" class={`${look} is-plain`} title={hint}>
        {name}
      </th>
    );
  }
  return (
    <th
      scope="col"
      class={look}
      aria-sort={isSorted ? (isDown ? "descending" : "ascending") : "none"}
    >
      <button
        type="button"
        title={hint}
        onClick={() => ask({ sort: nextSort(sort.peek(), column, isDownFirst) })}
      >
        {name}
        <span class="sort-sign" aria-hidden="true">
          {isSorted ? (isDown ? "▼" : "▲") : ""}
        </span>
      </button>
    </th>
  );
}

/** A page of runs as a table; narrow, each of them is a card. */
export function RunTable({ runs }: { runs: readonly RunSummary[] }) {
  return (
    <table class="run-table" aria-label={words.list}>
      <thead>
        <tr>
          <td class="run-pick" />
          <Head name={words.columns.name} sort={NAME_SORT} class="run-what" />
          <td class="run-spark" />
          {COLUMNS.map(({ key, ...column }) => (
            <Head key={key} {...column} class={`run-${key}`} />
          ))}
          <td class="run-act" />
        </tr>
      </thead>
      <tbody>
        {runs.map((run) => (
          <RunRow key={run.id} run={run} />
        ))}
      </tbody>
    </table>
  );
}
