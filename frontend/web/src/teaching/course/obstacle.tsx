/** What keeps one from beginning a step here, and the ways out. */
import type { Step } from "../../core/api/course";
import { isPrivate } from "../../core/api/request";
import {
  hasControl,
  isInstructor,
  isObserver,
  leaveControl,
  otherHolder,
  queue,
  wishControl,
} from "../../core/state/control";
import { bench, isLive } from "../../core/state/session";
import { text } from "../../core/text/en";
import { isHeld } from "../../hardware/hold";
import { isDoneHere, readinessOf } from "./benchstep";
import { cut, workApart } from "./lesson";

const words = text.lesson;

function Apart() {
  if (isPrivate) return null;
  return (
    <button type="button" class="button" title={words.apartHint} onClick={() => void workApart()}>
      {words.apart}
    </button>
  );
}

/** Whose turn it is, and one's own place; a place that is there can be left. */
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
          onClick={() => (place === null ? wishControl() : void leaveControl())}
        >
          {place !== null
            ? text.control.leaveQueue
            : inTurn !== null && !isInstructor.value
              ? words.ask
              : text.control.take}
        </button>
      )}
      <Apart />
    </>
  );
}

/** The last run of the step was cut off: by whom, when, and that it counts for nothing. */
export function CutOff({ of }: { of: Step }) {
  const last = cut.value;
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
  if (!isDoneHere(of, now)) {
    return (
      <div class="note row">
        <p>{words.simulatedOnly}</p>
        <Apart />
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
  const { before } = readinessOf(now, isHeld.value);
  if (before === null) return null;
  return (
    <div class="note row">
      <p role="status">
        <strong>{words.before}</strong> {text.bench.advice[before]} {words.above}
      </p>
      <Apart />
    </div>
  );
}
