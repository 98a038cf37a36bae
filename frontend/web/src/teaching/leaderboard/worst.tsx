import { worstRunAddress } from "../../core/api/ranking";
import { t } from "../../core/text/t";
import { formatFixed, formatNumber } from "../../core/units";
import { PlaceLink } from "../../runs/list/place";
import { ReplayFrame } from "../../runs/list/replayframe";
import { nameOf } from "./columns";
import { board, shownEntry } from "./leaderboard";

const PAPERS_LAW = "ndobc";
const ignoreMoment = () => {};

/** An entry's worst run in 3D, compared with NDOBC. */
export function WorstRun() {
  const entry = shownEntry.value;
  const back = (
    <PlaceLink to={{ kind: "leaderboard", entry: "" }} class="button">
      ← {t("leaderboard.back")}
    </PlaceLink>
  );
  if (entry === undefined) {
    return (
      <div class="bar row">
        {back}
        {board.value !== null && <p>{t("leaderboard.unknown")}</p>}
      </div>
    );
  }
  const { worst, success } = entry.standing;
  const name = nameOf(entry);
  const error =
    worst.rms_deg === null
      ? t("leaderboard.ended")
      : t("leaderboard.rms", { error: formatNumber(worst.rms_deg) });
  return (
    <>
      <div class="bar row">
        {back}
        <div class="grow">
          <h2>{t("leaderboard.worstOf", { name })}</h2>
          <p>
            {worst.title}: <strong>{error}</strong>
            {worst.problem && ` · ${worst.problem}`} ·{" "}
            {t("leaderboard.standing", {
              rank: entry.rank,
              success: t("leaderboard.percent", { share: formatFixed(100 * success, 1) }),
            })}
          </p>
          <p class="hint">
            {t("leaderboard.comparison", {
              law: entry.key === PAPERS_LAW ? "FL" : "NDOBC",
              source: entry.is_installed ? t("leaderboard.again") : t("leaderboard.replayed"),
            })}
          </p>
        </div>
      </div>
      <ReplayFrame
        key={entry.key}
        source={worstRunAddress(entry.key)}
        name={name}
        startS={0}
        onMoment={ignoreMoment}
      />
    </>
  );
}
