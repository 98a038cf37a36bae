/**
 * A push is one load: started, sent again while it is held, ended. The server ends it if the
 * repetitions stop.
 */
import { signal } from "@preact/signals";
import { addLoad, removeLoad } from "../api/client";
import type { Edit } from "../api/operations";
import type { Load, SessionState } from "../api/types";
import { perform } from "./actions";
import { acceptState, session } from "./session";

/** The components of a push while the user holds it; null without a push. */
type Components = readonly number[];

interface PushKind {
  /** Control that shows why it was rejected. */
  control: string;
  /** Smallest push that starts, and smallest change that is sent at once. */
  least: number;
  change: number;
  load(components: Components, holdS: number): Load;
}

const POLL_INTERVAL_MS = 60;
const UPDATE_MS = 200;
const SILENCE_S = 0.8;
const MIN_HOLD_S = 0.02;
const MAX_HOLD_S = 60;

type SessionSpeed = Pick<SessionState, "speed" | "real_time_factor">;

/** Session time between repetitions, at any speed of the session, s. */
export function holdDuration({ speed, real_time_factor: factor }: SessionSpeed): number {
  const pace = speed === "max" ? factor : speed;
  return Math.min(MAX_HOLD_S, Math.max(MIN_HOLD_S, SILENCE_S * pace));
}

const wait = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));

/** A push of one kind, which the user holds and releases. */
export class Push {
  readonly held = signal<Components | null>(null);
  #isSending = false;

  constructor(private readonly kind: PushKind) {}

  /** Whether to send a push: it starts, it changes, or a repetition is due. */
  isUpdateDue(now: Components, sent: Components | null, sinceMs: number): boolean {
    const { least, change } = this.kind;
    if (sent === null) return Math.hypot(...now) > least;
    const moved = Math.hypot(...now.map((value, index) => value - (sent[index] as number)));
    return moved > change || sinceMs >= UPDATE_MS;
  }

  hold(components: Components): void {
    this.held.value = components;
    void this.send();
  }

  release(): void {
    this.held.value = null;
  }

  /** Send `held` to the server until it is null, one request at a time. */
  async send(): Promise<void> {
    if (this.#isSending) return;
    this.#isSending = true;
    let [id, sent, writtenAt] = [null as number | null, null as Components | null, 0];
    const send = async (components: Components, pace: SessionSpeed, edit: Edit) => {
      const load = this.kind.load(components, holdDuration(pace));
      const state = await addLoad(load)(edit);
      id = state.loads.filter((row) => row.load.kind === load.kind).at(-1)?.id ?? null;
      return state;
    };
    for (let now = this.held.peek(); now !== null; now = this.held.peek()) {
      const [components, state] = [now, session.peek()];
      if (state && this.isUpdateDue(components, sent, performance.now() - writtenAt)) {
        [sent, writtenAt] = [components, performance.now()];
        const request = (edit: Edit) => send(components, state, edit);
        if (!(await perform(this.kind.control, request))) this.release();
      }
      await wait(POLL_INTERVAL_MS);
    }
    // The server has already ended this push: no request is needed.
    if (id !== null) await removeLoad(id)().then(acceptState, () => undefined);
    this.#isSending = false;
    if (this.held.peek() !== null) await this.send();
  }
}

/** A torque on the link, N·m. */
export const linkPush = new Push({
  control: "scene.push",
  least: 0.05,
  change: 0.02,
  load: ([torque = 0], hold_s) => ({ kind: "push", torque_nm: [torque, 0, 0], hold_s }),
});

/** A force at the tip of an arm, x to the right and y up, N. */
export const tipPush = new Push({
  control: "tip.push",
  least: 0.05,
  change: 0.05,
  load: ([x = 0, y = 0], hold_s) => ({ kind: "tip_push", force_n: [x, y], hold_s }) as Load,
});
