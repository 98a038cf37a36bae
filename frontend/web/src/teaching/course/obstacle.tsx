/** Obstacles to starting a step here, and the possible solutions. */

import type { Step } from "../../core/api/course";
import { isInstructor, isObserver } from "../../core/state/access";
import {
  hasControl,
  openOwnSession,
  otherHolder,
  queue,
  releaseControl,
  requestControl,
} from "../../core/state/control";
import { bench } from "../../core/state/plant";
import { isLive, session } from "../../core/state/session";
import { t } from "../../core/text/t";
import { formatFixed } from "../../core/units";
import { isSwitchHeld } from "../../hardware/hold";
import { PrivateSessionButton } from "../../lab/lease/privatesession";
import { isOfSession, isPossibleOn, readinessOf } from "./benchstep";
import { stepRun } from "./steprun";

/** The user in control, and this user's place in the queue, which the user can leave. */
function Turn() {
  const inTurn = queue.value;
  const place = inTurn?.place ?? null;
  const other = otherHolder.value;
  return (
    <>
      <p role="status">
        {other === null ? t("lesson.unheld") : t("lesson.held", { name: other })}{" "}
        {place !== null &&
          (place === 1
            ? t("classroom.next")
            : t("classroom.placeText", { place, total: inTurn?.waiting.length ?? 0 }))}
      </p>
      {!isObserver.value && (
        <button
          type="button"
          class="button"
          onClick={() => (place === null ? requestControl() : void releaseControl())}
        >
          {place !== null
            ? t("control.leaveQueue")
            : inTurn !== null && !isInstructor.value
              ? t("lesson.ask")
              : t("control.take")}
        </button>
      )}
      <PrivateSessionButton />
    </>
  );
}

/** The last run of the step was interrupted: by which user, when, and that it does not count. */
export function CutOff({ of }: { of: Step }) {
  const last = stepRun.value.interruption;
  if (last?.step !== of.name) return null;
  return (
    <p class="note is-bad" role="alert">
      {t(`lesson.cut.${last.why}`, { time: formatFixed(last.timeS, 1) })} {t("lesson.cutAgain")}
    </p>
  );
}

export function Obstacle({ of }: { of: Step }) {
  if (!isLive.value) return null;
  const now = bench.value;
  if (!isOfSession(of, session.value)) {
    return (
      <div class="note row">
        <p>{of.arm === "" ? t("lesson.jointOnly") : t("lesson.armOnly")}</p>
        <button type="button" class="button" onClick={() => void openOwnSession(of.arm)}>
          {of.arm === "" ? t("lesson.openJoint") : t("lesson.openArm")}
        </button>
      </div>
    );
  }
  if (!isPossibleOn(of, now)) {
    return (
      <div class="note row">
        <p>{t("lesson.simulatedOnly")}</p>
        <PrivateSessionButton />
      </div>
    );
  }
  if (!hasControl.value) {
    return (
      <div class="note row">
        <Turn />
      </div>
    );
  }
  const { nextAction: before } = readinessOf(now, isSwitchHeld.value);
  if (before === null) return null;
  return (
    <div class="note row">
      <p role="status">
        <strong>{t("lesson.before")}</strong> {t(`bench.advice.${before}`)} {t("lesson.above")}
      </p>
      <PrivateSessionButton />
    </div>
  );
}
