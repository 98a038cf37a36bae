import type { Row } from "../../core/api/ranking";
import { dotOf } from "../../core/plots/linestyles";
import { shortenFault } from "../../core/state/faults";
import { titleOf } from "../../core/state/laws";
import { text } from "../../core/text/en";
import { ScoreBar, SortHead } from "../../core/widgets/tables";
import { barOf, COLUMNS, type Column, formatValue, isBest } from "./columns";
import { choose, confirmed, lineStyles, measuring, opening, rows, see, sort } from "./ranking";

const words = text.ranking;

function Head({ column }: { column: Column }) {
  const { name, hint } = words.columns[column.key];
  return (
    <SortHead
      column={column.key}
      sort={sort.value}
      hint={hint}
      isDownFirst={column.isHighBetter}
      onSort={(next) => {
        sort.value = next;
      }}
    >
      {name}
      {column.unit && <span class="unit">{`\u00a0${column.unit}`}</span>}
    </SortHead>
  );
}

function Score({ row }: { row: Row }) {
  const { robustness, trials, accuracy } = row.parts;
  return (
    <td class="ranking-score" title={words.scoreOf(robustness, trials, accuracy)}>
      {row.score.toFixed(2)}
      <ScoreBar parts={row.parts} />
    </td>
  );
}

/** What stands where there is no number: why the run ended, or that it never settled. */
const wordsOf = (column: Column, row: Row): string => {
  const fault = column.faultOf(row);
  if (fault !== null) return shortenFault(fault);
  return column.key === "recovery" ? words.never : words.noNumber;
};

function Cell({ column, row }: { column: Column; row: Row }) {
  const value = column.read(row);
  const scenario = column.scenarioOf(row);
  const shown = value === null ? wordsOf(column, row) : formatValue(column, value);
  const best = isBest(column, row, rows.value);
  const look = value === null ? "is-fault" : best ? "is-best" : "";
  const law = titleOf(row.law);
  if (column.key === "score" || scenario === null) return <Score row={row} />;
  return (
    <td class={look}>
      <button
        type="button"
        title={words.see(law, words.columns[column.key].name)}
        aria-label={words.seeLabel(law, words.columns[column.key].name, shown, best)}
        disabled={opening.value !== ""}
        onClick={() => void see(row.law, scenario)}
      >
        {shown}
        {value !== null && (
          <span class="bar is-thin" aria-hidden="true">
            <i
              class={column.isHighBetter ? "is-high" : "is-low"}
              style={{ width: `${100 * barOf(column, value, rows.value)}%` }}
            />
          </span>
        )}
      </button>
    </td>
  );
}

/** Whether the published row came out again here. */
function Confirmed({ row }: { row: Row }) {
  const same = confirmed.value[row.law];
  if (measuring.value?.law === row.law) {
    return <span class="ranking-confirmed is-busy" role="img" aria-label={words.measuringLaw} />;
  }
  if (same === undefined) return null;
  return (
    <span
      class={`ranking-confirmed ${same ? "" : "is-other"}`}
      role="img"
      aria-label={same ? words.same : words.other}
      title={same ? words.same : words.other}
    >
      {same ? "✓" : "≠"}
    </span>
  );
}

/** A law a row; a press on a name brings it into the radar, a press on a number its run. */
export function RankingTable() {
  return (
    <section class="surface scroll" aria-label={words.table}>
      <table class="table wide-table ranking-table">
        <caption class="visually-hidden">{words.tableHint}</caption>
        <thead>
          <tr>
            <th scope="col" class="is-name">
              {words.law}
            </th>
            {COLUMNS.map((column) => (
              <Head key={column.key} column={column} />
            ))}
          </tr>
        </thead>
        <tbody>
          {rows.value.map((row) => {
            const lineStyle = lineStyles.value.get(row.law);
            return (
              <tr key={row.law}>
                <th scope="row" class="is-name ranking-law">
                  <button
                    type="button"
                    aria-pressed={lineStyle !== undefined}
                    title={words.chooseHint}
                    onClick={() => choose(row.law)}
                  >
                    <i class="dot" aria-hidden="true" style={dotOf(lineStyle)} />
                    {titleOf(row.law)}
                  </button>
                  <Confirmed row={row} />
                </th>
                {COLUMNS.map((column) => (
                  <Cell key={column.key} column={column} row={row} />
                ))}
              </tr>
            );
          })}
        </tbody>
      </table>
    </section>
  );
}
