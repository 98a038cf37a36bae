import type { ComponentChildren } from "preact";
import { t } from "../text/t";
import type { LineStyle } from "./definitions";
import { Swatch } from "./legend";

/** The measured controller. */
interface MeasuredRow {
  key: string;
  look: LineStyle;
  name: string;
}

export interface MetricsColumn {
  key: string;
  title: ComponentChildren;
  hint?: string | undefined;
  class?: string;
  /** Text of a row's value. */
  cell: (row: number) => ComponentChildren;
  cellHint?: (row: number) => string | undefined;
  /** The row that is marked as the best, or several rows. */
  best?: number | readonly number[];
}

interface MetricsTableProps {
  class?: string;
  label?: string;
  caption: ComponentChildren;
  captionHint?: string;
  /** Header of the column of row names. */
  corner: ComponentChildren;
  /** Header that several columns share. */
  groups?: readonly { title: ComponentChildren; columns: number }[];
  rows: readonly MeasuredRow[];
  columns: readonly MetricsColumn[];
}

/** Numbers of errors, one row per lane. */
export function MetricsTable({ label, caption, captionHint, ...rest }: MetricsTableProps) {
  const { class: look, corner, groups, rows, columns } = rest;
  const cornerHead = (
    <th scope="col" rowSpan={groups ? 2 : 1}>
      {corner}
    </th>
  );
  return (
    <table class={look} aria-label={label}>
      <caption title={captionHint}>{caption}</caption>
      <thead>
        {groups && (
          <tr>
            {cornerHead}
            {groups.map(({ title, columns: count }, index) => (
              <th key={index} scope="colgroup" colSpan={count}>
                {title}
              </th>
            ))}
          </tr>
        )}
        <tr>
          {!groups && cornerHead}
          {columns.map((column) => (
            <th key={column.key} scope="col" title={column.hint}>
              {column.title}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {rows.map((row, index) => (
          <tr key={row.key}>
            <th scope="row">
              <span class="line joined">
                <Swatch look={row.look} />
                <span class="legend-name">{row.name}</span>
              </span>
            </th>
            {columns.map((column) => (
              <Cell key={column.key} column={column} row={index} />
            ))}
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Cell({ column, row }: { column: MetricsColumn; row: number }) {
  const isBest = [column.best].flat().includes(row);
  const classes = [column.class, isBest && "is-best"].filter(Boolean).join(" ");
  return (
    <td class={classes || undefined} title={column.cellHint?.(row)}>
      {isBest && (
        <>
          <span aria-hidden="true">{t("compare.bestSign")}</span>
          <span class="visually-hidden">{t("compare.best")}</span>
        </>
      )}
      {column.cell(row)}
    </td>
  );
}
