/** State of a bench, possible commands, and the next step. */
import type { BenchState, BenchStatus, SessionState } from "../core/api/types";

export const STAGES = ["off", "reset", "config", "mode", "ready", "run"] as const;
type Stage = (typeof STAGES)[number];
type StagePosition = "done" | "here" | "ahead";

/** A ramp is the end of a run; a fault has no position in the sequence; null: unknown. */
export function stagePosition(stage: Stage, status: BenchStatus | null): StagePosition {
  if (status === "fault" || status === null) return "ahead";
  const here = STAGES.indexOf(status === "ramp" ? "run" : status);
  const index = STAGES.indexOf(stage);
  if (index === here) return "here";
  return index < here ? "done" : "ahead";
}

const isHomed = (bench: BenchState): boolean => bench.homing.next_step === null;

/** Whether its loop does not tick: the only command it accepts is a restart. */
export const isLoopLost = ({ loop }: BenchState): boolean => loop.state !== "ticking";

/** Whether its loop has never ticked: then it cannot have been lost. */
export const isNeverOpened = ({ loop }: BenchState): boolean => loop.state === "not_opened";

export const isStarting = ({ loop }: BenchState): boolean => loop.state === "starting";

export interface AllowedCommands {
  arm: boolean;
  run: boolean;
  stop: boolean;
  clear: boolean;
  restart: boolean;
  home: boolean;
}

/**
 * Commands that the server should accept; the server decides. isSwitchHeld: the dead-man's switch,
 * required for a start.
 */
export function allowedCommands(bench: BenchState, isSwitchHeld = false): AllowedCommands {
  const { status } = bench;
  return {
    arm: status === "off" && bench.problems.length === 0 && !isLoopLost(bench),
    run: status === "ready" && isHomed(bench) && (isSwitchHeld || !bench.dead_man),
    stop: status === "run",
    clear: status === "fault" && !isLoopLost(bench),
    restart: isLoopLost(bench) && !isStarting(bench),
    home: !isHomed(bench) && status === "ready",
  };
}

export type Advice =
  | "problems"
  | "loop"
  | "notOpened"
  | "starting"
  | "unsupervised"
  | "unheard"
  | "arm"
  | "wait"
  | "home"
  | "run"
  | "hold"
  | "running"
  | "ramping"
  | "clear";

/** The encoder may send before the drives are armed; the drives send only afterwards. */
function adviceBeforeArming(bench: BenchState): Advice {
  const { problems, supervised, ages_s: ages } = bench;
  if (problems.length > 0) return "problems";
  if (!supervised) return "unsupervised";
  return ["lost", "unheard"].includes(freshnessOf(ages[2], bench)) ? "unheard" : "arm";
}

/** The next step. isSwitchHeld: the dead-man's switch. */
export function adviceFor(bench: BenchState, isSwitchHeld = false): Advice {
  if (isStarting(bench)) return "starting";
  if (isLoopLost(bench)) return isNeverOpened(bench) ? "notOpened" : "loop";
  switch (bench.status) {
    case "off":
      return adviceBeforeArming(bench);
    case "ready":
      if (!isHomed(bench)) return "home";
      return allowedCommands(bench, isSwitchHeld).run ? "run" : "hold";
    case "run":
      return "running";
    case "ramp":
      return "ramping";
    case "fault":
      return "clear";
    default:
      return "wait";
  }
}

/** Whether the details contain something to read or do before it runs. */
export function needsDetails(bench: BenchState): boolean {
  const isStopped = bench.status === "off" || bench.status === "ready";
  return isStopped && !isStarting(bench) && (bench.problems.length > 0 || !isHomed(bench));
}

/** Whether a simulation is stopped after a quick stop. */
export function isStoppedSimulation({ bench, status, tick, events }: SessionState): boolean {
  const isStop = (event: { kind: string; tick: number }) =>
    event.kind === "quick_stop" && event.tick === tick;
  return bench === null && status === "paused" && events.some(isStop);
}

export const isQuickStop = ({ fault }: SessionState): boolean => fault?.code === "quick_stop";

// The histogram of a loop's lateness as bars, and the permitted age of a reading.

interface Bar {
  /** Upper edge, s; null for the last bin, which has none. */
  edgeS: number | null;
  count: number;
  /** From 0 to 1 on a logarithmic axis, so that one late tick in a million is visible. */
  height: number;
}

export function barsOf(edgesS: readonly number[], counts: readonly number[]): Bar[] {
  const top = Math.max(1, ...counts.map(decadesOf));
  return counts.map((count, index) => ({
    edgeS: edgesS[index] ?? null,
    count,
    height: decadesOf(count) / top,
  }));
}

/** Number of decades of the axis. */
export const decadesIn = (counts: readonly number[]): number =>
  Math.max(1, ...counts.map(decadesOf));

/** One tick is slightly above the baseline, ten are one decade higher. */
const BASELINE_DECADES = 0.3;
const decadesOf = (count: number): number =>
  count <= 0 ? 0 : BASELINE_DECADES + Math.log10(count);

export type Freshness = "fresh" | "stale" | "lost" | "silent" | "unheard";
/** Value of the server for a source without readings yet. */
const NO_READING_S = 1000;

/**
 * Compared with the bounds of the bench file, above which the torque becomes zero, and above which
 * a fault occurs. isExpected: whether readings are expected; a drive that is not armed sends none.
 */
export function freshnessOf(
  ageS: number,
  {
    stale_zero_s: staleS,
    stale_fault_s: lostS,
  }: Pick<BenchState, "stale_zero_s" | "stale_fault_s">,
  isExpected = true,
): Freshness {
  if (!(ageS <= lostS) && !isExpected) return "silent";
  if (ageS >= NO_READING_S) return "unheard";
  if (!(ageS <= lostS)) return "lost";
  return ageS > staleS ? "stale" : "fresh";
}
