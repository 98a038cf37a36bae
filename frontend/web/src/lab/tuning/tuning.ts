/** A search for a law's parameters on the server, as it is followed here. */
import { computed, signal } from "@preact/signals";
import { putGains, putObserver, putParameters } from "../../core/api/client";
import {
  type Candidate,
  listTunings,
  readTuning,
  startTuning,
  stopTuning,
  type Tuning,
} from "../../core/api/jobs";
import type { Law } from "../../core/api/types";
import { polling } from "../../core/jobs/poll";
import { isGoing } from "../../core/jobs/progress";
import { perform } from "../../core/state/actions";

export const CONTROL = "tuning.use";

export const isOpen = signal(false);
export const tuning = signal<Tuning | null>(null);
export const candidates = signal<readonly Candidate[]>([]);
export const problem = signal<unknown>(null);
export const isStarting = signal(false);

export const isUnderWay = computed(() => isGoing(tuning.value));

const poll = polling((error) => {
  problem.value = error;
});

function take(state: Tuning): void {
  const known = candidates.peek();
  const fresh = state.candidates.filter(({ number }) => number >= known.length);
  if (fresh.length > 0) candidates.value = [...known, ...fresh];
  tuning.value = state;
}

async function follow(id: string): Promise<void> {
  const ending = await poll.follow(
    () => readTuning(id, candidates.peek().length),
    (state) => {
      take(state);
      return !isGoing(state);
    },
  );
  if (ending === "refused") tuning.value = null;
}

export async function start(law: Law, budget: number): Promise<void> {
  problem.value = null;
  isStarting.value = true;
  try {
    const begun = await startTuning(law, budget);
    candidates.value = [];
    take(begun);
    void follow(begun.id);
  } catch (error) {
    problem.value = error;
  }
  isStarting.value = false;
}

export async function stop(): Promise<void> {
  const state = tuning.peek();
  if (state === null) return;
  try {
    await stopTuning(state.id);
  } catch (error) {
    problem.value = error;
  }
}

/** After a reload the page finds the newest search of this lab again. */
export async function findNewest(): Promise<void> {
  if (tuning.peek() !== null) return;
  try {
    const [newest] = await listTunings();
    if (newest === undefined || tuning.peek() !== null) return;
    void follow(newest.id);
  } catch (error) {
    problem.value = error;
  }
}

/** Puts the best into the session: parameters of its law, or gains and the observer. */
export async function applyBest(): Promise<boolean> {
  const setting = tuning.peek()?.best_setting;
  if (!setting) return false;
  const { law, parameters, gains } = setting;
  const betas = setting.observer?.bandwidth_rad_per_s;
  const isSet =
    (!parameters || (await perform(CONTROL, () => putParameters({ [law]: parameters })))) &&
    (!gains || (await perform(CONTROL, () => putGains(gains))));
  return isSet && (!betas || perform(CONTROL, () => putObserver(...betas)));
}

/** The best cost so far, after every candidate. */
export function bestSoFar(tried: readonly Candidate[]): [number, number][] {
  let best = Number.POSITIVE_INFINITY;
  return tried.map(({ number, cost }) => {
    best = Math.min(best, cost);
    return [number, best];
  });
}
