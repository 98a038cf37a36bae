/** A push is one load: started, sent again while it is held, ended. The server ends it when
 * it hears no more of it. */
import { signal } from "@preact/signals";
import { addLoad, removeLoad } from "../../core/api/client";
import type { Load, SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { acceptState, session } from "../../core/state/session";

/** The torque that is held on the link now, N·m; null without a push. */
export const heldTorque = signal<number | null>(null);

const MIN_NM = 0.05;
const CHANGE_NM = 0.02;
const LOOK_MS = 60;
const UPDATE_MS = 200;
const SILENCE_S = 0.8;
const MIN_HOLD_S = 0.02;
const MAX_HOLD_S = 60;

type Pace = Pick<SessionState, "speed" | "real_time_factor">;

/** Session time in which the page is heard again however fast the session goes, s. */
export function holdOf({ speed, real_time_factor: factor }: Pace): number {
  const pace = speed === "max" ? factor : speed;
  return Math.min(MAX_HOLD_S, Math.max(MIN_HOLD_S, SILENCE_S * pace));
}

/** Whether a torque is sent: it starts a push, it differs, or a repetition is due. */
export function isUpdateDue(torque: number, sent: number | null, sinceMs: number): boolean {
  if (sent === null) return Math.abs(torque) > MIN_NM;
  return Math.abs(torque - sent) > CHANGE_NM || sinceMs >= UPDATE_MS;
}

const wait = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));
const numberOf = ({ loads }: SessionState): number | null =>
  loads.filter(({ load }) => load.kind === "push").at(-1)?.id ?? null;

let isKept = false;

/** Sends `heldTorque` to the server until it is null, never two calls at once. */
export async function keepPush(): Promise<void> {
  if (isKept) return;
  isKept = true;
  let [id, sent, writtenAt] = [null as number | null, null as number | null, 0];
  const send = async (torque: number, pace: Pace) => {
    const load: Load = { kind: "push", torque_nm: [torque, 0, 0], hold_s: holdOf(pace) };
    const state = await addLoad(load);
    id = numberOf(state);
    return state;
  };
  for (let torque = heldTorque.peek(); torque !== null; torque = heldTorque.peek()) {
    const [now, state] = [torque, session.peek()];
    if (state && isUpdateDue(now, sent, performance.now() - writtenAt)) {
      [sent, writtenAt] = [now, performance.now()];
      if (!(await perform("scene.push", () => send(now, state)))) heldTorque.value = null;
    }
    await wait(LOOK_MS);
  }
  // The server has already ended this push: nothing is left to do.
  if (id !== null) await removeLoad(id).then(acceptState, () => undefined);
  isKept = false;
  if (heldTorque.peek() !== null) await keepPush();
}
