/** The draft design: its settings, its predicted effect, and the settings in use. */
import { computed, signal } from "@preact/signals";
import { putGains, putObserver } from "../../core/api/client";
import { type Prediction, predict } from "../../core/api/design";
import type { Configuration, SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { session } from "../../core/state/session";
import { type Pole, type Poles, polesOf, toRequest } from "./poles";

export type Group = "position" | "stiffness";

export interface Draft {
  position: Poles;
  stiffness: Poles;
  observer: readonly [number, number, number];
}

export const isOpen = signal(false);
const changed = signal<Draft | null>(null);
export const expected = signal<Prediction | null>(null);
export const present = signal<Prediction | null>(null);
export const isAsking = signal(false);
export const isApplying = signal(false);

/** What was set when the draft was begun. */
let seen: SessionState | null = null;

const PAUSE_MS = 90;
const RETRY_MS = 1500;
let timer: ReturnType<typeof setTimeout> | undefined;
let asked = 0;

function draftOf({ gains, observer }: Configuration): Draft {
  return {
    position: polesOf(gains.position_roots_rad_per_s),
    stiffness: polesOf(gains.stiffness_roots_rad_per_s),
    observer: observer.bandwidth_rad_per_s,
  };
}

export const inUse = computed<Draft | null>(() => {
  const state = session.value;
  return state && draftOf(state.configuration);
});
export const draft = computed(() => changed.value ?? inUse.value);
export const isChanged = computed(
  () => changed.value !== null && JSON.stringify(changed.value) !== JSON.stringify(inUse.value),
);
/** Everything that the prediction depends on besides the draft. */
export const surroundings = computed(() => {
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

export function requestOf(wanted: Draft): Parameters<typeof predict>[0] {
  const [p1, p2, p3, p4] = wanted.position.map(toRequest) as [number, number, number, number];
  const [s1, s2] = wanted.stiffness.map(toRequest) as [number, number];
  return {
    gains: {
      position_poles_rad_per_s: [p1, p2, p3, p4],
      stiffness_poles_rad_per_s: [s1, s2],
    },
    observer: { bandwidth_rad_per_s: [...wanted.observer] },
  };
}

async function ask(): Promise<void> {
  const wanted = draft.peek();
  if (wanted === null) return;
  const number = ++asked;
  try {
    const now = present.peek() ?? (await predict({}));
    const answer = isChanged.peek() ? await predict(requestOf(wanted)) : now;
    if (number !== asked) return;
    present.value = now;
    expected.value = answer;
    isAsking.value = false;
  } catch {
    if (number === asked) timer = setTimeout(() => void ask(), RETRY_MS);
  }
}

function askSoon(): void {
  clearTimeout(timer);
  isAsking.value = true;
  timer = setTimeout(() => void ask(), PAUSE_MS);
}

/** While the panel is open: asks again whenever the session is set otherwise. */
export function watchSurroundings(): () => void {
  const stop = surroundings.subscribe(() => {
    present.value = null;
    askSoon();
  });
  return () => {
    stop();
    clearTimeout(timer);
    asked++;
  };
}

export function tryPoles(group: Group, poles: readonly Pole[]): void {
  const before = draft.peek();
  if (before === null) return;
  if (changed.peek() === null) seen = session.peek();
  changed.value = { ...before, [group]: poles };
  askSoon();
}

export function tryObserver(bandwidth: number): void {
  const before = draft.peek();
  if (before === null) return;
  if (changed.peek() === null) seen = session.peek();
  changed.value = { ...before, observer: [bandwidth, bandwidth, bandwidth] };
  askSoon();
}

export function discard(): void {
  changed.value = null;
  askSoon();
}

/** Only what was changed is sent: the gains' coefficients stay to the last bit where they may. */
export async function apply(): Promise<void> {
  const wanted = changed.peek();
  const now = inUse.peek();
  if (wanted === null || now === null) return;
  isApplying.value = true;
  const { gains } = requestOf(wanted);
  const isOther = (key: keyof Draft) => JSON.stringify(wanted[key]) !== JSON.stringify(now[key]);
  const send = async () => {
    const state =
      gains && (isOther("position") || isOther("stiffness")) ? await putGains(gains) : null;
    return isOther("observer") || state === null ? putObserver(...wanted.observer) : state;
  };
  const isDone = await perform("design.apply", send, seen);
  isApplying.value = false;
  if (isDone) changed.value = null;
}
