import type { RunDetails } from "../core/api/types";
import { t } from "../core/text/t";
import { isLabShown, PlaceLink, place } from "../runs/list/place";
import { type SaveStatus, saveStatus } from "../runs/list/saved";
import { formatDuration } from "../runs/list/words";
import { isRunOfLesson } from "../teaching/course/steprun";

function describeSaved({
  state,
  title,
  duration_s: durationS,
  message,
}: RunDetails): [string, string] {
  if (state === "complete")
    return [t("recording.saved"), `${title} · ${formatDuration(durationS)}`];
  return [t("recording.savedPartly"), `${title} · ${formatDuration(durationS)}. ${message}`];
}

/** The run of a step is reported next to the step, unless its record is incomplete. */
const isShownThere = (now: SaveStatus): boolean =>
  isRunOfLesson(now.run) &&
  (now.stage === "saving" || (now.stage === "saved" && now.details.state === "complete"));

/** After a recording: that it is being saved, and then the name of the run. */
export function SavedNote() {
  const last = isLabShown(place.value) ? saveStatus.value : null;
  const now = last === null || isShownThere(last) ? null : last;
  const [head, rest] =
    now === null
      ? ["", ""]
      : now.stage === "saved"
        ? describeSaved(now.details)
        : now.stage === "saving"
          ? [t("recording.saving"), ""]
          : [t("recording.savedUnknown"), ""];
  const close = () => {
    saveStatus.value = null;
  };
  return (
    <div class="line floating toast" role="status" hidden={now === null}>
      {now && (
        <>
          <p>
            <strong>{head}</strong> {rest}
          </p>
          {now.stage === "saved" && (
            <span onClickCapture={close}>
              <PlaceLink to={{ kind: "run", run: now.run, timeS: 0 }} class="button">
                {t("recording.open")}
              </PlaceLink>
            </span>
          )}
          {now.stage !== "saving" && (
            <button type="button" class="quiet" aria-label={t("runs.dismiss")} onClick={close}>
              ✕
            </button>
          )}
        </>
      )}
    </div>
  );
}
