/** What gains and observer were before: a step for every change, whoever made it. */
import { effect, signal } from "@preact/signals";
import { putGains, putObserver } from "../api/client";
import type { Configuration, SessionState } from "../api/types";
import { perform } from "../state/actions";
import { session } from "../state/session";

const MOST_STEPS = 50;

export interface Design {
  position: readonly number[];
  stiffness: readonly number[];
  observer: readonly [number, number, number];
}

export const steps = signal<readonly Design[]>([]);

let known: Design | null = null;
let isUndoing = false;

function designOf({ gains, observer }: Configuration): Design {
  return {
    position: gains.position_coefficients,
    stiffness: gains.stiffness_coefficients,
    observer: observer.bandwidth_rad_per_s,
  };
}

export const isSame = (one: Design, other: Design): boolean =>
  JSON.stringify(one) === JSON.stringify(other);

/** The steps after a change to `next`: the one before it is kept. */
export function keepStep(kept: readonly Design[], before: Design): Design[] {
  return [...kept, before].slice(-MOST_STEPS);
}

export function watchDesign(): void {
  effect(() => {
    const state = session.value;
    if (state === null) return;
    const design = designOf(state.configuration);
    if (known !== null && !isSame(known, design) && !isUndoing) {
      steps.value = keepStep(steps.peek(), known);
    }
    known = design;
  });
}

async function put(design: Design): Promise<SessionState> {
  const [c0, c1, c2, c3] = design.position as [number, number, number, number];
  const [s0, s1] = design.stiffness as [number, number];
  await putGains({ position_coefficients: [c0, c1, c2, c3], stiffness_coefficients: [s0, s1] });
  return putObserver(...design.observer);
}

/** Back by one step; resolves false where the server refused. */
export async function undo(): Promise<boolean> {
  const last = steps.peek().at(-1);
  if (last === undefined || isUndoing) return false;
  isUndoing = true;
  const isDone = await perform("design.undo", () => put(last));
  isUndoing = false;
  if (isDone) steps.value = steps.peek().slice(0, -1);
  return isDone;
}
