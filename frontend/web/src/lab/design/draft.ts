/** The draft design: its settings, its predicted behaviour, and the settings in use. */

import { computed, signal } from "@preact/signals";
import { putGains, putObserver } from "../../core/api/client";
import { type Prediction, predict } from "../../core/api/design";
import type { Edit } from "../../core/api/operations";
import type { Configuration, SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { settings as session } from "../../core/state/arm";
import { type Pole, type Poles, polesOf, toRequest } from "./poles";

export type Group = "position" | "stiffness";

export interface Draft {
  position: Poles;
  stiffness: Poles;
  observer: readonly [number, number, number];
}

export const isOpen = signal(false);
const changedDraft = signal<Draft | null>(null);
export const draftPrediction = signal<Prediction | null>(null);
export const currentPrediction = signal<Prediction | null>(null);
export const isPredicting = signal(false);
export const isApplying = signal(false);

/** Settings when the draft was started. */
let baseState: SessionState | null = null;

const PAUSE_MS = 90;
const RETRY_MS = 1500;
let timer: ReturnType<typeof setTimeout> | undefined;
let requestNumber = 0;

function draftOf({ gains, observer }: Configuration): Draft {
  return {
    position: polesOf(gains.position_roots_rad_per_s),
    stiffness: polesOf(gains.stiffness_roots_rad_per_s),
    observer: observer.bandwidth_rad_per_s,
  };
}

export const designInUse = computed<Draft | null>(() => {
  const state = session.value;
  return state && draftOf(state.configuration);
});
export const draft = computed(() => changedDraft.value ?? designInUse.value);
export const isChanged = computed(
  () =>
    changedDraft.value !== null &&
    JSON.stringify(changedDraft.value) !== JSON.stringify(designInUse.value),
);
/** All other inputs of the prediction. */
export const predictionInputs = computed(() => {
  const state = session.value;
  if (state === null) return "";
  const { gains, observer, law, stiffness, position, effects, limits } = state.configuration;
  return JSON.stringify([
    state.run_number,
    gains,
    observer,
    law,
    stiffness,
    position,
    effects,
    limits,
  ]);
});

export function requestOf(design: Draft): Parameters<typeof predict>[0] {
  const [p1, p2, p3, p4] = design.position.map(toRequest) as [number, number, number, number];
  const [s1, s2] = design.stiffness.map(toRequest) as [number, number];
  return {
    gains: {
      position_poles_rad_per_s: [p1, p2, p3, p4],
      stiffness_poles_rad_per_s: [s1, s2],
    },
    observer: { bandwidth_rad_per_s: [...design.observer] },
  };
}

async function updatePredictions(): Promise<void> {
  const design = draft.peek();
  if (design === null) return;
  const number = ++requestNumber;
  try {
    const now = currentPrediction.peek() ?? (await predict({}));
    const answer = isChanged.peek() ? await predict(requestOf(design)) : now;
    if (number !== requestNumber) return;
    currentPrediction.value = now;
    draftPrediction.value = answer;
    isPredicting.value = false;
  } catch {
    if (number === requestNumber) timer = setTimeout(() => void updatePredictions(), RETRY_MS);
  }
}

function schedulePrediction(): void {
  clearTimeout(timer);
  isPredicting.value = true;
  timer = setTimeout(() => void updatePredictions(), PAUSE_MS);
}

/** While the panel is open: request again whenever the settings of the session change. */
export function watchPredictionInputs(): () => void {
  const stop = predictionInputs.subscribe(() => {
    currentPrediction.value = null;
    schedulePrediction();
  });
  return () => {
    stop();
    clearTimeout(timer);
    requestNumber++;
  };
}

export function setDraftPoles(group: Group, poles: readonly Pole[]): void {
  const before = draft.peek();
  if (before === null) return;
  if (changedDraft.peek() === null) baseState = session.peek();
  changedDraft.value = { ...before, [group]: poles };
  schedulePrediction();
}

export function setDraftObserver(bandwidth: number): void {
  const before = draft.peek();
  if (before === null) return;
  if (changedDraft.peek() === null) baseState = session.peek();
  changedDraft.value = { ...before, observer: [bandwidth, bandwidth, bandwidth] };
  schedulePrediction();
}

export function discard(): void {
  changedDraft.value = null;
  schedulePrediction();
}

/** Only changes are sent: unchanged coefficients of the gains stay bit-identical. */
export async function apply(): Promise<void> {
  const design = changedDraft.peek();
  const now = designInUse.peek();
  if (design === null || now === null) return;
  isApplying.value = true;
  const { gains } = requestOf(design);
  const differs = (key: keyof Draft) => JSON.stringify(design[key]) !== JSON.stringify(now[key]);
  const send = async (edit: Edit) => {
    const state =
      gains && (differs("position") || differs("stiffness")) ? await putGains(gains)(edit) : null;
    return differs("observer") || state === null ? putObserver(...design.observer)(edit) : state;
  };
  const isDone = await perform("design.apply", send, baseState);
  isApplying.value = false;
  if (isDone) changedDraft.value = null;
}
