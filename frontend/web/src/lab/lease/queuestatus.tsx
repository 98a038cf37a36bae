import type { SessionState } from "../../core/api/types";
import { access, isInstructor, isObserver } from "../../core/state/access";
import { control, handOver, releaseControl, requestControl } from "../../core/state/control";
import { isLive } from "../../core/state/session";
import { t } from "../../core/text/t";
import { Banner } from "../../core/widgets/banner";
import { PrivateSessionButton } from "./privatesession";

type Queue = NonNullable<SessionState["queue"]>;

/** The holder of control in a class's session, and the user's own position; otherwise empty. */
function describeTurn(queue: Queue): { title: string; more: string } | null {
  const now = control.value;
  const [next] = queue.waiting;
  if (now?.mine) {
    return next === undefined
      ? null
      : {
          title:
            queue.waiting.length === 1
              ? t("classroom.waits", { name: next.name })
              : t("classroom.waitMore", { name: next.name, more: queue.waiting.length - 1 }),
          more: t("classroom.goesOn", { seconds: Math.round(queue.idle_s) }),
        };
  }
  const title = queue.locked
    ? t("classroom.lockedTitle")
    : now?.holder
      ? t("control.heldTitle", { name: now.holder })
      : t("classroom.freeTitle");
  if (queue.place !== null) {
    return {
      title,
      more:
        queue.place === 1
          ? t("classroom.next")
          : t("classroom.placeText", { place: queue.place, total: queue.waiting.length }),
    };
  }
  if (isInstructor.value && !now?.holder && !queue.locked) return null;
  if (isInstructor.value && !now?.holder) return { title, more: t("classroom.lockedByYou") };
  return { title, more: isObserver.value ? t("classroom.observerText") : t("control.heldText") };
}

function Act({ queue }: { queue: Queue }) {
  const [next] = queue.waiting;
  const isMine = control.value?.mine === true;
  if (isMine && next !== undefined) {
    return (
      <button
        type="button"
        class="button"
        disabled={!isLive.value}
        onClick={() => void handOver(next.id)}
      >
        {t("classroom.handOver", { name: next.name })}
      </button>
    );
  }
  if (isMine || isObserver.value || isInstructor.value) return null;
  const waits = queue.place !== null;
  return (
    <>
      <button
        type="button"
        class="button"
        disabled={!isLive.value}
        onClick={() => (waits ? void releaseControl() : requestControl())}
      >
        {waits ? t("control.leaveQueue") : t("control.ask")}
      </button>
      <PrivateSessionButton />
    </>
  );
}

/** Shows the next user in the queue; nothing before the lab has reported the user's identity. */
export function QueueStatus({ queue }: { queue: Queue }) {
  const turn = access.value === null ? null : describeTurn(queue);
  if (turn === null) return null;
  return (
    <Banner look="is-accent" sign="▪" title={turn.title} words={turn.more}>
      <Act queue={queue} />
    </Banner>
  );
}
