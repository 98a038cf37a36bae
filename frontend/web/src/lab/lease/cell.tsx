import {
  control,
  isInstructor,
  isObserver,
  mayCommand,
  otherHolder,
  queue,
  releaseControl,
  requestControl,
} from "../../core/state/control";
import { isLive } from "../../core/state/session";
import { text } from "../../core/text/en";

const words = text.control;

function Button() {
  const other = otherHolder.value;
  const isMine = control.value?.mine === true;
  const inTurn = queue.value;
  const waits = inTurn !== null && inTurn.place !== null;
  if (isObserver.value) return null;
  const [label, hint] = isMine
    ? [words.giveBack, inTurn === null ? words.giveBackHint : words.giveOnHint]
    : waits
      ? [words.leaveQueue, words.leaveQueueHint]
      : inTurn !== null && !isInstructor.value
        ? [words.ask, words.askHint]
        : other === null
          ? [words.take, words.takeHint]
          : [words.takeOver, words.takeOverHint(other)];
  return (
    <button
      type="button"
      class="button is-small"
      disabled={!isLive.value}
      title={hint}
      onClick={() => (isMine || waits ? void releaseControl() : requestControl())}
    >
      {label}
    </button>
  );
}

/** In the status bar: the holder of control, the number of viewers, and the button to change it. */
export function ControlCell() {
  const now = control.value;
  if (now === null) return null;
  const inTurn = queue.value;
  const free = inTurn === null ? words.everyone : inTurn.locked ? words.locked : words.free;
  const holder = now.mine ? words.you : (now.holder ?? free);
  const who = isLive.value ? holder : text.status.notKnown;
  const sign = now.holder === null || !isLive.value ? "○" : now.mine ? "●" : "▪";
  return (
    <div
      class={`rigid small nowrap status-cell is-control ${now.mine ? "is-mine" : ""} ${mayCommand.value ? "" : "is-other"}`}
      title={words.hint}
    >
      <dt>{words.heading}</dt>
      <dd>
        <span role="status">
          <span aria-hidden="true">{sign}</span> <span class="clip control-name">{who}</span>
        </span>{" "}
        {isLive.value && (
          <small>
            · {inTurn?.place ? words.place(inTurn.place) : words.watching(now.watching)}
          </small>
        )}
      </dd>
      <dd class="control-act">
        <Button />
      </dd>
    </div>
  );
}
