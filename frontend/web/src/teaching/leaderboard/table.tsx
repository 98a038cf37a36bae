import type { BoardEntry } from "../../core/api/ranking";
import { titleOf } from "../../core/state/laws";
import { text } from "../../core/text/en";
import { formatNumber } from "../../core/units";
import { SortHeads } from "../../core/widgets/tables";
import { PlaceLink } from "../../runs/list/place";
import { formatMoment, formatMomentShort } from "../../runs/list/words";
import { COLUMNS, nameOf } from "./columns";
import { board, entries, sort, submittedKey } from "./leaderboard";

const words = text.leaderboard;

/** The success rate with the bounds of its interval. */
function Success({ standing }: BoardEntry) {
  const { success, low, high, trials, trials_held } = standing;
  return (
    <td class="number" title={words.trialsHeld(trials_held, trials)}>
      <strong>{words.percent(success)}</strong>{" "}
      <small title={words.intervalHint}>
        {words.interval(words.percent(low), words.percent(high))}
      </small>
    </td>
  );
}

function Row({ entry }: { entry: BoardEntry }) {
  const { standing } = entry;
  const { worst } = standing;
  const name = nameOf(entry);
  const error = worst.rms_deg === null ? words.ended : words.degrees(formatNumber(worst.rms_deg));
  const look = [
    entry.is_installed ? "is-baseline" : "",
    entry.key === submittedKey.value ? "is-mine" : "",
  ];
  return (
    <tr class={look.join(" ")}>
      <td class="number">{entry.rank}</td>
      <th scope="row" class="is-name">
        {name}
        <small>
          {entry.is_installed ? (
            <span title={words.baselineHint}>{words.baseline}</span>
          ) : entry.author ? (
            <span title={entry.person}>{words.by(entry.author)}</span>
          ) : (
            words.submittedLaw
          )}
        </small>
      </th>
      <Success {...entry} />
      <td class="number">{standing.trials_ended}</td>
      <td class="number">
        {standing.median_rms_deg === null ? words.ended : formatNumber(standing.median_rms_deg)}
      </td>
      <td class="number">{standing.tick_us === null ? "–" : standing.tick_us.toFixed(1)}</td>
      <td class="is-worst">
        <PlaceLink
          to={{ kind: "leaderboard", entry: entry.key }}
          title={worst.problem || words.seeHint(name)}
        >
          <span class="visually-hidden">{words.see(name)}</span>
          <b class={worst.rms_deg === null ? "bad" : ""}>{error}</b>{" "}
          <small class="block">{worst.title}</small>
        </PlaceLink>
      </td>
      <td title={words.measuredWith(formatMoment(entry.entered), entry.version)}>
        {formatMomentShort(entry.entered)}
      </td>
    </tr>
  );
}

/** An installed law that is not yet measured in this season. */
const Missing = ({ law }: { law: string }) => (
  <tr class="is-baseline muted">
    <td class="number">–</td>
    <th scope="row" class="is-name">
      {titleOf(law)}
      <small>{words.baseline}</small>
    </th>
    <td colSpan={COLUMNS.length - 2}>{words.notMeasured}</td>
  </tr>
);

/** One row per entry: the submitted laws among those of the lab. */
export function BoardTable() {
  return (
    <section class="surface card" aria-labelledby="board-entries">
      <h3 id="board-entries">{words.entries}</h3>
      <section class="scroll" aria-label={words.table}>
        <table class="table wide-table board-table">
          <caption class="visually-hidden">{words.tableHint}</caption>
          <thead>
            <tr>
              <SortHeads columns={COLUMNS} words={words.columns} sort={sort} />
            </tr>
          </thead>
          <tbody>
            {entries.value.map((entry) => (
              <Row key={entry.key} entry={entry} />
            ))}
            {board.value?.missing.map((law) => (
              <Missing key={law} law={law} />
            ))}
          </tbody>
        </table>
      </section>
      <p class="hint">{words.note}</p>
    </section>
  );
}
