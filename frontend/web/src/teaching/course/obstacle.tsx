/** Obstacles to starting a step here, and the possible solutions. */
import type { Step } from "../../core/api/course";
import {
  hasControl,
  isInstructor,
  isObserver,
  openOwnSession,
  otherHolder,
  queue,
  releaseControl,
  requestControl,
} from "../../core/state/control";
import { bench, isLive, session } from "../../core/state/session";
import { text } from "../../core/text/en";
import { isSwitchHeld } from "../../hardware/hold";
import { PrivateSessionButton } from "../../lab/lease/privatesession";
import { isOfSession, isPossibleOn, readinessOf } from "./benchstep";
import { stepRun } from "./steprun";

const words = text.lesson;

/** The user in control, and this user's place in the queue, which the user can leave. */
function Turn() {
  const inTurn = queue.value;
  const place = inTurn?.place ?? null;
  const other = otherHolder.value;
  return (
    <>
      <p role="status">
        {other === null ? words.unheld : words.held(other)}{" "}
        {place !== null && text.classroom.placeText(place, inTurn?.waiting.length ?? 0)}
      </p>
      {!isObserver.value && (
        <button
          type="button"
          class="button"
          onClick={() => (place === null ? requestControl() : void releaseControl())}
        >
          {place !== null
            ? text.control.leaveQueue
            : inTurn !== null && !isInstructor.value
              ? words.ask
              : text.control.take}
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
      {words.cut[last.why](last.timeS.toFixed(1))} {words.cutAgain}
    </p>
  );
}

export function Obstacle({ of }: { of: Step }) {
  if (!isLive.value) return null;
  const now = bench.value;
  if (!isOfSession(of, session.value)) {
    return (
      <div class="note row">
        <p>{of.arm === "" ? words.jointOnly : words.armOnly}</p>
        <button type="button" class="button" onClick={() => void openOwnSession(of.arm)}>
          {of.arm === "" ? words.openJoint : words.openArm}
        </button>
      </div>
    );
  }
  if (!isPossibleOn(of, now)) {
    return (
      <div class="note row">
        <p>{words.simulatedOnly}</p>
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
        <strong>{words.before}</strong> {text.bench.advice[before]} {words.above}
      </p>
      <PrivateSessionButton />
    </div>
  );
}
