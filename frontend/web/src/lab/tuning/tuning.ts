/** The tuning job that the page follows. */
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
import { isJobRunning } from "../../core/jobs/progress";
import { createWork } from "../../core/jobs/work";
import { perform } from "../../core/state/actions";

export const CONTROL = "tuning.use";

export const isOpen = signal(false);
export const tuning = signal<Tuning | null>(null);
export const candidates = signal<readonly Candidate[]>([]);

export const isTuning = computed(() => isJobRunning(tuning.value));

const work = createWork();
export const { problem, isBusy } = work;

function applyTuning(state: Tuning): void {
  const existing = candidates.peek();
  const added = state.candidates.filter(({ number }) => number >= existing.length);
  if (added.length > 0) candidates.value = [...existing, ...added];
  tuning.value = state;
}

async function follow(id: string): Promise<void> {
  const pollEnd = await work.poll(
    () => readTuning(id, candidates.peek().length),
    (state) => {
      applyTuning(state);
      return !isJobRunning(state);
    },
  );
  if (pollEnd === "refused") tuning.value = null;
}

/** Throws if it is rejected. */
export async function start(request: object): Promise<void> {
  const started = await work.run("start", () => startTuning(request));
  candidates.value = [];
  applyTuning(started);
  void follow(started.id);
}

export async function stop(): Promise<void> {
  const state = tuning.peek();
  if (state !== null) await work.attempt(() => stopTuning(state.id));
}

/** After a reload the page follows the newest tuning of this lab again. */
export async function findNewest(): Promise<void> {
  if (tuning.peek() !== null) return;
  const [newest] = (await work.attempt(listTunings)) ?? [];
  if (newest !== undefined && tuning.peek() === null) void follow(newest.id);
}

/** Apply the best candidate to the session: parameters of its law, or gains and the observer. */
export async function applyBest(): Promise<boolean> {
  const setting = tuning.peek()?.best_setting;
  if (!setting) return false;
  const { law, parameters, gains } = setting;
  const betas = setting.observer?.bandwidth_rad_per_s;
  const areGainsSet =
    (!parameters || (await perform(CONTROL, putParameters({ [law]: parameters })))) &&
    (!gains || (await perform(CONTROL, putGains(gains))));
  return areGainsSet && (!betas || perform(CONTROL, putObserver(...betas)));
}

/** The best cost so far, after every candidate. */
export function bestSoFar(tried: readonly Candidate[]): [number, number][] {
  let best = Number.POSITIVE_INFINITY;
  return tried.map(({ number, cost }) => {
    best = Math.min(best, cost);
    return [number, best];
  });
}
