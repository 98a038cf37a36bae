import type { BoardEntry } from "../../core/api/ranking";
import { titleOf } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { formatFixed, formatNumber } from "../../core/units";
import { SortHeads } from "../../core/widgets/tables";
import { PlaceLink } from "../../runs/list/place";
import { formatMoment, formatMomentShort } from "../../runs/list/words";
import { COLUMNS, nameOf } from "./columns";
import { board, entries, sort, submittedKey } from "./leaderboard";

/** The success rate with the bounds of its interval. */
function Success({ standing }: BoardEntry) {
  const { success, low, high, trials, trials_held } = standing;
  return (
    <td class="number" title={t("leaderboard.trialsHeld", { held: trials_held, of: trials })}>
      <strong>{t("leaderboard.percent", { share: formatFixed(100 * success, 1) })}</strong>{" "}
      <small title={t("leaderboard.intervalHint")}>
        {t("leaderboard.interval", {
          low: t("leaderboard.percent", { share: formatFixed(100 * low, 1) }),
          high: t("leaderboard.percent", { share: formatFixed(100 * high, 1) }),
        })}
      </small>
    </td>
  );
}

function Row({ entry }: { entry: BoardEntry }) {
  const { standing } = entry;
  const { worst } = standing;
  const name = nameOf(entry);
  const error =
    worst.rms_deg === null
      ? t("leaderboard.ended")
      : t("leaderboard.degrees", { error: formatNumber(worst.rms_deg) });
  const look = [
    entry.is_installed ? "is-baseline" : "",
    entry.key === submittedKey.value ? "is-mine" : "",
  ];
  return (
    <tr class={look.join(" ")}>
      <td class="number">{entry.rank}</td>
      <th scope="row" class="is-name strong">
        {name}
        <small class="block">
          {entry.is_installed ? (
            <span title={t("leaderboard.baselineHint")}>{t("leaderboard.baseline")}</span>
          ) : entry.author ? (
            <span title={entry.person}>{t("leaderboard.by", { author: entry.author })}</span>
          ) : (
            t("leaderboard.submittedLaw")
          )}
        </small>
      </th>
      <Success {...entry} />
      <td class="number">{standing.trials_ended}</td>
      <td class="number">
        {standing.median_rms_deg === null
          ? t("leaderboard.ended")
          : formatNumber(standing.median_rms_deg)}
      </td>
      <td class="number">{standing.tick_us === null ? "–" : formatFixed(standing.tick_us, 1)}</td>
      <td>
        <PlaceLink
          to={{ kind: "leaderboard", entry: entry.key }}
          title={worst.problem || t("leaderboard.seeHint", { name })}
        >
          <span class="visually-hidden">{t("leaderboard.see", { name })}</span>
          <b class={worst.rms_deg === null ? "bad" : ""}>{error}</b>{" "}
          <small class="block">{worst.title}</small>
        </PlaceLink>
      </td>
      <td
        title={t("leaderboard.measuredWith", {
          when: formatMoment(entry.entered),
          version: entry.version,
        })}
      >
        {formatMomentShort(entry.entered)}
      </td>
    </tr>
  );
}

/** An installed law that is not yet measured in this season. */
const Missing = ({ law }: { law: string }) => (
  <tr class="is-baseline muted">
    <td class="number">–</td>
    <th scope="row" class="is-name strong">
      {titleOf(law)}
      <small class="block">{t("leaderboard.baseline")}</small>
    </th>
    <td colSpan={COLUMNS.length - 2}>{t("leaderboard.notMeasured")}</td>
  </tr>
);

/** One row per entry: the submitted laws among those of the lab. */
export function BoardTable() {
  return (
    <section class="surface card" aria-labelledby="board-entries">
      <h3 id="board-entries">{t("leaderboard.entries")}</h3>
      <section class="scroll" aria-label={t("leaderboard.table")}>
        <table class="table wide-table board-table">
          <caption class="visually-hidden">{t("leaderboard.tableHint")}</caption>
          <thead>
            <tr>
              <SortHeads columns={COLUMNS} words="leaderboard.columns" sort={sort} />
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
      <p class="hint">{t("leaderboard.note")}</p>
    </section>
  );
}
