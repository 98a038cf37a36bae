import type { ComponentChildren } from "preact";
import { t } from "../text/t";
import { Swatch } from "./legend";
import { listGroups, type MeasuredLane, readCell } from "./metricrows";

interface AllMetricsProps {
  /** The measured window. */
  caption: ComponentChildren;
  lanes: readonly MeasuredLane[];
}

/** Every metric of a window, one column per lane: position, stiffness and effort. */
export function AllMetrics({ caption, lanes }: AllMetricsProps) {
  return (
    <table class="metrics" aria-label={t("metrics.all")}>
      <caption>{caption}</caption>
      <thead>
        <tr>
          <td />
          {lanes.map(({ key, look, name }) => (
            <th key={key} scope="col">
              <Swatch look={look} /> <span class="legend-name">{name}</span>
            </th>
          ))}
        </tr>
      </thead>
      {listGroups(lanes).map(({ name, remark, rows }) => (
        <tbody key={name}>
          <tr>
            <th scope="colgroup" class="hint strong" colSpan={1 + lanes.length}>
              {name} <span class="unit">{remark}</span>
            </th>
          </tr>
          {rows.map((row) => (
            <tr key={row.name}>
              <th scope="row" title={row.hint}>
                {row.name} <span class="unit">{row.unit}</span>
              </th>
              {lanes.map((lane) => {
                const { value, hint } = readCell(row, lane);
                return (
                  <td key={lane.key} title={hint}>
                    {value}
                  </td>
                );
              })}
            </tr>
          ))}
        </tbody>
      ))}
    </table>
  );
}
