import { isInstructor, isObserver } from "../../core/state/access";
import {
  control,
  mayCommand,
  otherHolder,
  queue,
  releaseControl,
  requestControl,
} from "../../core/state/control";
import { isLive } from "../../core/state/session";
import { t } from "../../core/text/t";

function Button() {
  const other = otherHolder.value;
  const isMine = control.value?.mine === true;
  const inTurn = queue.value;
  const waits = inTurn !== null && inTurn.place !== null;
  if (isObserver.value) return null;
  const [label, hint] = isMine
    ? [t("control.giveBack"), inTurn === null ? t("control.giveBackHint") : t("control.giveOnHint")]
    : waits
      ? [t("control.leaveQueue"), t("control.leaveQueueHint")]
      : inTurn !== null && !isInstructor.value
        ? [t("control.ask"), t("control.askHint")]
        : other === null
          ? [t("control.take"), t("control.takeHint")]
          : [t("control.takeOver"), t("control.takeOverHint", { name: other })];
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
  const free =
    inTurn === null
      ? t("control.everyone")
      : inTurn.locked
        ? t("control.locked")
        : t("control.free");
  const holder = now.mine ? t("control.you") : (now.holder ?? free);
  const who = isLive.value ? holder : t("status.notKnown");
  const sign = now.holder === null || !isLive.value ? "○" : now.mine ? "●" : "▪";
  return (
    <div
      class={`rigid small nowrap status-cell is-control ${mayCommand.value ? "" : "is-other"}`}
      title={t("control.hint")}
    >
      <dt>{t("control.heading")}</dt>
      <dd>
        <span role="status" class={now.mine ? "tone is-accent" : ""}>
          <span aria-hidden="true">{sign}</span> <span class="clip control-name">{who}</span>
        </span>{" "}
        {isLive.value && (
          <small>
            ·{" "}
            {inTurn?.place
              ? t("control.place", { place: inTurn.place })
              : t("control.watching", { count: now.watching })}
          </small>
        )}
      </dd>
      <dd class="control-act">
        <Button />
      </dd>
    </div>
  );
}
