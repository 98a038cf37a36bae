import type { SessionState } from "../../core/api/types";
import {
  access,
  control,
  handOver,
  isInstructor,
  isObserver,
  releaseControl,
  requestControl,
} from "../../core/state/control";
import { isLive } from "../../core/state/session";
import { text } from "../../core/text/en";
import { Banner } from "../../core/widgets/banner";
import { PrivateSessionButton } from "./privatesession";

const words = text.classroom;
type Queue = NonNullable<SessionState["queue"]>;

/** The holder of control in a class's session, and the user's own position; otherwise empty. */
function describeTurn(queue: Queue): { title: string; more: string } | null {
  const now = control.value;
  const [next] = queue.waiting;
  if (now?.mine) {
    return next === undefined
      ? null
      : { title: words.waits(next.name, queue.waiting.length), more: words.goesOn(queue.idle_s) };
  }
  const title = queue.locked
    ? words.lockedTitle
    : now?.holder
      ? text.control.heldTitle(now.holder)
      : words.freeTitle;
  if (queue.place !== null) {
    return { title, more: words.placeText(queue.place, queue.waiting.length) };
  }
  if (isInstructor.value && !now?.holder && !queue.locked) return null;
  if (isInstructor.value && !now?.holder) return { title, more: words.lockedByYou };
  return { title, more: isObserver.value ? words.observerText : text.control.heldText };
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
        {words.handOver(next.name)}
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
        {waits ? text.control.leaveQueue : text.control.ask}
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
    <Banner look="is-news is-calm" sign="▪" title={turn.title} words={turn.more}>
      <Act queue={queue} />
    </Banner>
  );
}
