/**
 * The dead-man's switch: held by a pointer, a key on its button, or the key D, and its messages.
 */
import { computed, effect, signal } from "@preact/signals";
import type { BenchState } from "../core/api/types";
import { mayCommand } from "../core/state/control";
import { sendSwitchHeld, session } from "../core/state/session";

export type SwitchInput = "pointer" | "button" | "key";
/** Reason for the end of the last run: the user released it, or the page was too busy to send. */
type HoldEnd = "letGo" | "late";
type HoldMessage = "idle" | "ready" | "armed" | "running" | "dropped" | HoldEnd;

const PERIOD_MS = 40;
/** Silence after which the bench ramps to zero. */
const SILENCE_TIMEOUT_MS = 100;
/** A run that ends within this time after a silence of this page has ended because of it. */
const LATE_WINDOW_MS = 1000;
const activeInputs = new Set<SwitchInput>();
let timer: ReturnType<typeof setInterval> | undefined;
let sentAt = 0;
let lateAt = Number.NEGATIVE_INFINITY;

export const isSwitchHeld = signal(false);
/** Null from the next hold or the next run on. */
export const holdEnd = signal<HoldEnd | null>(null);

/** Whether holding it has an effect. */
export const isSwitchEffective = (): boolean =>
  mayCommand.peek() && session.peek()?.bench?.dead_man === true;

export function pressInput(input: SwitchInput): void {
  if (!isSwitchEffective()) return;
  activeInputs.add(input);
  if (isSwitchHeld.peek()) return;
  isSwitchHeld.value = true;
  holdEnd.value = null;
  sendSwitchHeld();
  sentAt = performance.now();
  timer = setInterval(resend, PERIOD_MS);
}

const isRunning = (): boolean => session.peek()?.bench?.status === "run";

function resend(): void {
  const now = performance.now();
  if (now - sentAt > SILENCE_TIMEOUT_MS) lateAt = now;
  sentAt = now;
  sendSwitchHeld();
}

export function releaseInput(input: SwitchInput): void {
  if (activeInputs.delete(input) && activeInputs.size === 0) release();
}

function releaseAll(): void {
  if (activeInputs.size === 0) return;
  activeInputs.clear();
  release();
}

function release(): void {
  clearInterval(timer);
  isSwitchHeld.value = false;
  if (isRunning()) holdEnd.value = "letGo";
}

/** Message for the user. */
export function holdMessage(
  status: BenchState["status"],
  held: boolean,
  end: HoldEnd | null,
): HoldMessage {
  if (status === "run" && held) return "running";
  if (status === "run" || status === "ramp") return "dropped";
  if (status !== "ready") return "idle";
  return end ?? (held ? "armed" : "ready");
}

/**
 * The switch is released if the user leaves the page: another window, another tab, a lost
 * connection.
 */
export function watchHold(): void {
  window.addEventListener("blur", releaseAll);
  window.addEventListener("pagehide", releaseAll);
  document.addEventListener("visibilitychange", () => {
    if (document.hidden) releaseAll();
  });
  effect(() => {
    if (!mayCommand.value || session.value?.bench?.dead_man !== true) releaseAll();
  });
  const isBenchRunning = computed(() => session.value?.bench?.status === "run");
  effect(() => {
    if (isBenchRunning.value) holdEnd.value = null;
    else if (isSwitchHeld.peek() && performance.now() - lateAt < LATE_WINDOW_MS)
      holdEnd.value = "late";
  });
}
