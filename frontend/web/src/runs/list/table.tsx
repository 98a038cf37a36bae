import type { RunSummary } from "../../core/api/types";
import { t } from "../../core/text/t";
import { SortHead } from "../../core/widgets/tables";
import { COLUMNS, type Column, NAME_SORT } from "./columns";
import { changeQuery, sort } from "./list";
import { RunRow } from "./row";

interface HeadProps
  extends Pick<Column, "name" | "hint" | "sort" | "isDownFirst" | "isNumber">,
    Partial<Pick<Column, "width">> {
  class: string;
}

function Head({ name, hint, sort: column, isDownFirst, isNumber, width, ...rest }: HeadProps) {
  const look = `${rest.class} ${isNumber ? "number" : ""}`;
  if (column === undefined) {
    return (
      <th scope="col" class={look} style={{ width }} title={hint}>
        {name}
      </th>
    );
  }
  return (
    <SortHead
      column={{ key: column, isDownFirst, class: look, width }}
      words={{ name, hint }}
      sort={sort.value}
      onSort={(next) => changeQuery({ sort: next })}
    />
  );
}

/** A page of runs as a table; on a narrow screen as cards. */
export function RunTable({ runs }: { runs: readonly RunSummary[] }) {
  return (
    <table class="surface run-table" aria-label={t("runs.list")}>
      <thead>
        <tr>
          <td class="run-pick" />
          <Head name={t("runs.columns.name")} sort={NAME_SORT} class="run-what" />
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
