import { worstRunAddress } from "../../core/api/ranking";
import { text } from "../../core/text/en";
import { formatNumber } from "../../core/units";
import { PlaceLink } from "../../runs/list/place";
import { ReplayFrame } from "../../runs/list/replayframe";
import { nameOf } from "./columns";
import { board, shownEntry } from "./leaderboard";

const words = text.leaderboard;
const PAPERS_LAW = "ndobc";
const ignoreMoment = () => {};

/** An entry's worst run in 3D, compared with NDOBC. */
export function WorstRun() {
  const entry = shownEntry.value;
  const back = (
    <PlaceLink to={{ kind: "leaderboard", entry: "" }} class="button">
      ← {words.back}
    </PlaceLink>
  );
  if (entry === undefined) {
    return (
      <div class="bar run-head">
        {back}
        {board.value !== null && <p>{words.unknown}</p>}
      </div>
    );
  }
  const { worst, success } = entry.standing;
  const name = nameOf(entry);
  const error = worst.rms_deg === null ? words.ended : words.rms(formatNumber(worst.rms_deg));
  return (
    <>
      <div class="bar run-head">
        {back}
        <div class="grow">
          <h2>{words.worstOf(name)}</h2>
          <p>
            {worst.title}: <strong>{error}</strong>
            {worst.problem && ` · ${worst.problem}`} ·{" "}
            {words.standing(entry.rank, text.leaderboard.percent(success))}
          </p>
          <p class="hint">
            {words.comparison(entry.key === PAPERS_LAW ? "FL" : "NDOBC", entry.is_installed)}
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
