/** The dead-man's switch: held by a pointer, a key on its button, or the key D, and its messages. */
import { computed, effect, signal } from "@preact/signals";
import type { BenchState } from "../core/api/types";
import { mayCommand } from "../core/state/control";
import { saySwitchIsHeld, session } from "../core/state/session";

export type Grip = "pointer" | "button" | "key";
/** What ended the last run of this page's holding: its user, or its being too busy to be heard. */
type Ended = "letGo" | "late";
type HoldWords = "idle" | "ready" | "armed" | "running" | "dropped" | Ended;

const PERIOD_MS = 40;
/** Silence after which the bench ramps to zero. */
const SILENCE_MS = 100;
/** A run that ends so soon after such a silence of this page has ended for it. */
const LATE_MS = 1000;
const grips = new Set<Grip>();
let timer: ReturnType<typeof setInterval> | undefined;
let saidAt = 0;
let lateAt = Number.NEGATIVE_INFINITY;

export const isHeld = signal(false);
/** Null from the next holding or the next run on. */
export const ended = signal<Ended | null>(null);

/** Whether holding it would count. */
export const canHold = (): boolean => mayCommand.peek() && session.peek()?.bench?.dead_man === true;

export function hold(grip: Grip): void {
  if (!canHold()) return;
  grips.add(grip);
  if (isHeld.peek()) return;
  isHeld.value = true;
  ended.value = null;
  saySwitchIsHeld();
  saidAt = performance.now();
  timer = setInterval(sayAgain, PERIOD_MS);
}

const isRunning = (): boolean => session.peek()?.bench?.status === "run";

function sayAgain(): void {
  const now = performance.now();
  if (now - saidAt > SILENCE_MS) lateAt = now;
  saidAt = now;
  saySwitchIsHeld();
}

export function letGo(grip: Grip): void {
  if (grips.delete(grip) && grips.size === 0) release();
}

function letGoAll(): void {
  if (grips.size === 0) return;
  grips.clear();
  release();
}

function release(): void {
  clearInterval(timer);
  isHeld.value = false;
  if (isRunning()) ended.value = "letGo";
}

/** What to say of it. */
export function wordsFor(
  status: BenchState["status"],
  held: boolean,
  end: Ended | null,
): HoldWords {
  if (status === "run" && held) return "running";
  if (status === "run" || status === "ramp") return "dropped";
  if (status !== "ready") return "idle";
  return end ?? (held ? "armed" : "ready");
}

/** The switch is released if the user leaves the page: another window, another tab, a lost connection. */
export function watchHold(): void {
  window.addEventListener("blur", letGoAll);
  window.addEventListener("pagehide", letGoAll);
  document.addEventListener("visibilitychange", () => {
    if (document.hidden) letGoAll();
  });
  effect(() => {
    if (!mayCommand.value || session.value?.bench?.dead_man !== true) letGoAll();
  });
  const runs = computed(() => session.value?.bench?.status === "run");
  effect(() => {
    if (runs.value) ended.value = null;
    else if (isHeld.peek() && performance.now() - lateAt < LATE_MS) ended.value = "late";
  });
}
