/** An experiment on a bench: conditions before the start, manual actions, and its end. */
import type { Step } from "../../core/api/course";
import type { BenchState, SessionState } from "../../core/api/types";
import { type Advice, adviceFor } from "../../hardware/status";

/** Whether a bench is ready for a step: to be configured, and to run. */
interface Readiness {
  /** It is stopped, and accepts a configuration. */
  canConfigure: boolean;
  /** A start command would take effect at once. */
  canRun: boolean;
  /** Manual action before it runs; null for none, and while it runs. */
  nextAction: Advice | null;
}

const READY: Readiness = { canConfigure: true, canRun: true, nextAction: null };
const STOPPED_STATES = ["off", "ready"] as const;

/** A simulation is always ready. isSwitchHeld: the dead-man's switch. */
export function readinessOf(bench: BenchState | null, isSwitchHeld: boolean): Readiness {
  if (bench === null) return READY;
  const advice = adviceFor(bench, isSwitchHeld);
  const isStopped =
    bench.loop.state === "ticking" && STOPPED_STATES.some((state) => state === bench.status);
  const canRun = advice === "run";
  return {
    canConfigure: isStopped,
    canRun,
    nextAction: canRun || advice === "running" ? null : advice,
  };
}

/** Whether a step can be done on this plant. */
export const isPossibleOn = (step: Step, bench: BenchState | null): boolean =>
  bench === null || step.bench !== null;

/** Whether step and session are both of an arm, or both of a single joint. */
export const isOfSession = (step: Step, state: SessionState | null): boolean =>
  state === null || (step.arm !== "") === ((state.configuration.arm ?? null) !== null);

/** Settings of a step's run on this plant. */
export const criteriaOf = (step: Step, bench: BenchState | null): readonly string[] =>
  (bench !== null && step.bench?.criteria) || step.criteria;

type ManualLoad = NonNullable<Step["bench"]>["manual_loads"][number];
const SHOWN_AFTER_S = 2;

/** The next manual action, or the one that was just due; null if none is left. */
export const dueManualLoad = (step: Step, timeS: number): ManualLoad | null =>
  step.bench?.manual_loads.find(({ time_s: at }) => timeS < at + SHOWN_AFTER_S) ?? null;

export type RunInterruption = "control" | "stopped";

/** Why a run will not be completed; null while it continues. hasControl: this page may command. */
export function findInterruption(state: SessionState, hasControl: boolean): RunInterruption | null {
  const { bench } = state;
  if (!hasControl) return "control";
  const isStopped = bench !== null && bench.status !== "run" && state.time_s > 0;
  return isStopped && bench.status !== "fault" ? "stopped" : null;
}
