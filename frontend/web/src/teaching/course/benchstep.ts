/** An experiment on a bench: what keeps it from being begun, what is done by hand, and how it ends. */
import type { Step } from "../../core/api/course";
import type { BenchState, SessionState } from "../../core/api/types";
import { type Advice, adviceFor } from "../../hardware/status";

/** What a bench may be asked for by a step: to be set to it, and to run. */
interface Readiness {
  /** It stands, and takes a configuration. */
  mayBeSet: boolean;
  /** It would start at once. */
  mayRun: boolean;
  /** What is to be done before it runs; null where nothing is, and while it runs. */
  before: Advice | null;
}

const READY: Readiness = { mayBeSet: true, mayRun: true, before: null };
const STANDING = ["off", "ready"] as const;

/** A simulation is always ready. held: the dead-man's switch. */
export function readinessOf(bench: BenchState | null, held: boolean): Readiness {
  if (bench === null) return READY;
  const advice = adviceFor(bench, held);
  const stands = bench.loop.state === "ticking" && STANDING.some((one) => one === bench.status);
  const mayRun = advice === "run";
  return { mayBeSet: stands, mayRun, before: mayRun || advice === "running" ? null : advice };
}

/** Whether a step can be done where one is. */
export const isDoneHere = (of: Step, bench: BenchState | null): boolean =>
  bench === null || of.bench !== null;

/** What is asked of its run there. */
export const askedOf = (of: Step, bench: BenchState | null): readonly string[] =>
  (bench !== null && of.bench?.criteria) || of.criteria;

type Hand = NonNullable<Step["bench"]>["manual_loads"][number];
const STILL_SHOWN_S = 2;

/** What is to be done by hand next, or was due a moment ago; null where nothing is left. */
export const handDue = (of: Step, timeS: number): Hand | null =>
  of.bench?.manual_loads.find(({ time_s: at }) => timeS < at + STILL_SHOWN_S) ?? null;

export type Cut = "control" | "stopped";

/** Why a run will not be completed; null while it continues. hasControl: this page may command. */
export function findCut(state: SessionState, hasControl: boolean): Cut | null {
  const { bench } = state;
  if (!hasControl) return "control";
  const stands = bench !== null && bench.status !== "run" && state.time_s > 0;
  return stands && bench.status !== "fault" ? "stopped" : null;
}
