/** The dead-man's switch: held by a pointer, a key on its button, or the key D, and how it is told. */
import { effect, signal } from "@preact/signals";
import type { BenchState } from "../api/types";
import { mayCommand } from "../state/control";
import { saySwitchIsHeld, session } from "../state/session";

export type Grip = "pointer" | "button" | "key";
export type HoldWords = "idle" | "ready" | "armed" | "running" | "dropped" | "stopped";

/** Well inside the 0.1 s after which the bench ramps to zero. */
const PERIOD_MS = 40;
const grips = new Set<Grip>();
let timer: ReturnType<typeof setInterval> | undefined;

export const isHeld = signal(false);
/** Whether it was let go while the bench ran, and has not been held since. */
export const wasLetGo = signal(false);

/** Whether holding it would count. */
export const canHold = (): boolean => mayCommand.peek() && session.peek()?.bench?.dead_man === true;

export function hold(grip: Grip): void {
  if (!canHold()) return;
  grips.add(grip);
  if (isHeld.peek()) return;
  isHeld.value = true;
  wasLetGo.value = false;
  saySwitchIsHeld();
  timer = setInterval(saySwitchIsHeld, PERIOD_MS);
}

export function letGo(grip: Grip): void {
  if (grips.delete(grip) && grips.size === 0) release();
}

export function letGoAll(): void {
  if (grips.size === 0) return;
  grips.clear();
  release();
}

function release(): void {
  clearInterval(timer);
  isHeld.value = false;
  wasLetGo.value = session.peek()?.bench?.status === "run";
}

/** What to say of it. */
export function wordsFor(status: BenchState["status"], held: boolean, letGone: boolean): HoldWords {
  if (status === "run") return held ? "running" : "dropped";
  if (status === "ramp") return "dropped";
  if (status !== "ready") return "idle";
  if (held) return "armed";
  return letGone ? "stopped" : "ready";
}

/** Whatever takes the page from its user lets go: another window, another tab, a lost connection. */
export function watchHold(): void {
  window.addEventListener("blur", letGoAll);
  window.addEventListener("pagehide", letGoAll);
  document.addEventListener("visibilitychange", () => {
    if (document.hidden) letGoAll();
  });
  effect(() => {
    if (!mayCommand.value || session.value?.bench?.dead_man !== true) letGoAll();
  });
}
