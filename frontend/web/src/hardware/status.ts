/** Where a bench is, what may be done there, and what comes next. */
import type { BenchState, BenchStatus, SessionState } from "../core/api/types";

export const STAGES = ["off", "reset", "config", "mode", "ready", "run"] as const;
type Stage = (typeof STAGES)[number];
type Place = "done" | "here" | "ahead";

/** A ramp is the end of a run; a fault is nowhere on the way; null: unknown. */
export function placeOf(stage: Stage, status: BenchStatus | null): Place {
  if (status === "fault" || status === null) return "ahead";
  const here = STAGES.indexOf(status === "ramp" ? "run" : status);
  const index = STAGES.indexOf(stage);
  if (index === here) return "here";
  return index < here ? "done" : "ahead";
}

const isHomed = (bench: BenchState): boolean => bench.homing.next_step === null;

/** Whether its loop does not tick: the only command it accepts is a restart. */
export const isLoopLost = ({ loop }: BenchState): boolean => loop.state !== "ticking";

/** Whether its loop has never ticked: there is nothing that could have been lost. */
export const isNeverOpened = ({ loop }: BenchState): boolean => loop.state === "not_opened";

export const isStarting = ({ loop }: BenchState): boolean => loop.state === "starting";

export interface Allowed {
  arm: boolean;
  run: boolean;
  stop: boolean;
  clear: boolean;
  restart: boolean;
  home: boolean;
}

/** What the server will take; it has the last word. held: the dead-man's switch, which a start needs. */
export function allowedOn(bench: BenchState, held = false): Allowed {
  const { status } = bench;
  return {
    arm: status === "off" && bench.problems.length === 0 && !isLoopLost(bench),
    run: status === "ready" && isHomed(bench) && (held || !bench.dead_man),
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

/** The encoder may be heard before the drives are armed; they speak only then. */
function adviceBeforeArming(bench: BenchState): Advice {
  const { problems, supervised, ages_s: ages } = bench;
  if (problems.length > 0) return "problems";
  if (!supervised) return "unsupervised";
  return ["lost", "unheard"].includes(freshnessOf(ages[2], bench)) ? "unheard" : "arm";
}

/** The next thing to do. held: the dead-man's switch. */
export function adviceFor(bench: BenchState, held = false): Advice {
  if (isStarting(bench)) return "starting";
  if (isLoopLost(bench)) return isNeverOpened(bench) ? "notOpened" : "loop";
  switch (bench.status) {
    case "off":
      return adviceBeforeArming(bench);
    case "ready":
      if (!isHomed(bench)) return "home";
      return allowedOn(bench, held).run ? "run" : "hold";
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

/** Whether the details have something to be read or done before it runs. */
export function needsDetails(bench: BenchState): boolean {
  const isStanding = bench.status === "off" || bench.status === "ready";
  return isStanding && !isStarting(bench) && (bench.problems.length > 0 || !isHomed(bench));
}

/** Whether a simulation stands where a quick stop left it. */
export function isStoppedSimulation({ bench, status, tick, events }: SessionState): boolean {
  const isStop = (event: { kind: string; tick: number }) =>
    event.kind === "quick_stop" && event.tick === tick;
  return bench === null && status === "paused" && events.some(isStop);
}

export const isQuickStop = ({ fault }: SessionState): boolean => fault?.code === "quick_stop";

// The histogram of a loop's lateness as bars, and how old a reading may be.

interface Bar {
  /** Upper edge, s; null for the last bin, which has none. */
  edgeS: number | null;
  count: number;
  /** From 0 to 1 on a logarithmic axis, so that one late tick in a million is still seen. */
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

/** How many decades of the axis the bars fill. */
export const decadesIn = (counts: readonly number[]): number =>
  Math.max(1, ...counts.map(decadesOf));

/** One tick stands a little above the ground, ten one decade higher. */
const FOOT = 0.3;
const decadesOf = (count: number): number => (count <= 0 ? 0 : FOOT + Math.log10(count));

export type Freshness = "fresh" | "stale" | "lost" | "silent" | "unheard";
/** What the server says where there was nothing to be heard yet. */
const UNHEARD_S = 1000;

/**
 * By the bounds of the bench file, above which the torque goes to zero, and above which it is a
 * fault. speaks: whether it should be heard at all; a drive that is not armed says nothing.
 */
export function freshnessOf(
  ageS: number,
  {
    stale_zero_s: staleS,
    stale_fault_s: lostS,
  }: Pick<BenchState, "stale_zero_s" | "stale_fault_s">,
  speaks = true,
): Freshness {
  if (!(ageS <= lostS) && !speaks) return "silent";
  if (ageS >= UNHEARD_S) return "unheard";
  if (!(ageS <= lostS)) return "lost";
  return ageS > staleS ? "stale" : "fresh";
}
