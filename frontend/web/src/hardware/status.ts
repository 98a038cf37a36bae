/** Where a bench is, what may be done there, and what comes next. */
import type { BenchState, BenchStatus, SessionState } from "../core/api/types";
import { freshnessOf } from "./lateness";

export const STAGES = ["off", "reset", "config", "mode", "ready", "run"] as const;
export type Stage = (typeof STAGES)[number];
export type Place = "done" | "here" | "ahead";

/** A ramp is the end of a run; a fault is nowhere on the way; null: nobody knows where it is. */
export function placeOf(stage: Stage, status: BenchStatus | null): Place {
  if (status === "fault" || status === null) return "ahead";
  const here = STAGES.indexOf(status === "ramp" ? "run" : status);
  const index = STAGES.indexOf(stage);
  if (index === here) return "here";
  return index < here ? "done" : "ahead";
}

export const isHomed = (bench: BenchState): boolean => bench.homing.next_step === null;

/** Whether its loop does not tick: nothing can be asked of it but to be started anew. */
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
