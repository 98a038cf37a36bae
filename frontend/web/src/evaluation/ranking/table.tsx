import type { Row } from "../../core/api/ranking";
import { t } from "../../core/text/t";
import { SortHeads } from "../../core/widgets/tables";
import { COLUMNS, type Column } from "./columns";
import { chosen, isBusy, openInLab, results, rows, sort, titleOfRow } from "./ranking";

function Cell({ column, row }: { column: Column; row: Row }) {
  const ranking = results.value;
  if (ranking === null) return <td />;
  const shown = column.write(row, ranking);
  const scenario = column.scenarioOf?.(row);
  if (scenario === undefined) return <td class="number">{shown}</td>;
  return (
    <td class="number">
      <button
        type="button"
        title={t("ranking.see", {
          law: titleOfRow(row),
          column: t(`ranking.columns.${column.key}.name`),
        })}
        aria-label={t("ranking.seeLabel", {
          law: titleOfRow(row),
          column: t(`ranking.columns.${column.key}.name`),
          value: shown,
        })}
        disabled={isBusy.value !== ""}
        onClick={() => void openInLab(row.key, scenario)}
      >
        {shown}
      </button>
    </td>
  );
}

interface TableProps {
  columns?: readonly Column[];
}

/** One row per entry; its name opens its description, a fixed scenario opens its worst run. */
export function RankingTable({ columns = COLUMNS }: TableProps) {
  return (
    <section class="surface scroll" aria-label={t("ranking.table")}>
      <table class="table wide-table">
        <caption class="visually-hidden">{t("ranking.tableHint")}</caption>
        <thead>
          <tr>
            <th scope="col" class="is-name">
              {t("ranking.law")}
            </th>
            <SortHeads columns={columns} words="ranking.columns" sort={sort} />
          </tr>
        </thead>
        <tbody>
          {rows.value.map((row) => (
            <tr key={row.key}>
              <th scope="row" class="is-name">
                <button
                  type="button"
                  aria-pressed={chosen.value === row.key}
                  title={t("ranking.chooseHint")}
                  onClick={() => {
                    chosen.value = row.key;
                  }}
                >
                  {titleOfRow(row)}
                </button>
              </th>
              {columns.map((column) => (
                <Cell key={column.key} column={column} row={row} />
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}
