/** The draft design: its settings, and the settings in use. */
import { computed, signal } from "@preact/signals";
import { putGains, putObserver } from "../../core/api/client";
import type { DesignRequest } from "../../core/api/design";
import type { Edit } from "../../core/api/operations";
import type { Configuration, SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { isArm, settings as session, settingsJoint } from "../../core/state/arm";
import { type Pole, type Poles, polesOf, toRequest } from "./poles";

export type Group = "position" | "stiffness";

export interface Draft {
  position: Poles;
  stiffness: Poles;
  observer: readonly [number, number, number];
}

export const isOpen = signal(false);
const changedDraft = signal<Draft | null>(null);
export const isApplying = signal(false);

/** Settings when the draft was started. */
let baseState: SessionState | null = null;

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
/** Changes only if a value changes. */
export const draftKey = computed(() => JSON.stringify(draft.value));
/** All other inputs of the prediction. */
export const predictionInputs = computed(() => {
  const state = session.value;
  if (state === null) return "";
  const { gains, observer, law, stiffness, position, effects, limits } = state.configuration;
  return JSON.stringify([
    state.run_number,
    settingsJoint.value,
    gains,
    observer,
    law,
    stiffness,
    position,
    effects,
    limits,
  ]);
});

export function requestOf(design: Draft): DesignRequest {
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

/** The request for the settings in use, of an arm for those of the chosen joint. */
export const requestInUse = (): DesignRequest =>
  isArm.peek() ? { joint: settingsJoint.peek() } : {};

/** The request for the design in the plane. */
export function designRequest(): DesignRequest {
  const tried = draft.peek();
  const changed = tried !== null && isChanged.peek() ? requestOf(tried) : {};
  return { ...requestInUse(), ...changed };
}

export function setDraftPoles(group: Group, poles: readonly Pole[]): void {
  const before = draft.peek();
  if (before === null) return;
  if (changedDraft.peek() === null) baseState = session.peek();
  changedDraft.value = { ...before, [group]: poles };
}

export function setDraftObserver(bandwidth: number): void {
  const before = draft.peek();
  if (before === null) return;
  if (changedDraft.peek() === null) baseState = session.peek();
  changedDraft.value = { ...before, observer: [bandwidth, bandwidth, bandwidth] };
}

export function discard(): void {
  changedDraft.value = null;
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
