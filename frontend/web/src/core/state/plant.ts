/** What a session or a run came from: a simulation, the emulated rig, metal, or nobody knows yet. */
import type { BenchState, RunDetails } from "../api/types";

export type Mark = "emulated" | "real" | "unknown";

/** Nothing is claimed of a bench whose bus has not been listened to. */
export function markOfBench({ emulated }: BenchState): Mark {
  if (emulated === null) return "unknown";
  return emulated ? "emulated" : "real";
}

/** The mark of a recorded run; a simulation needs none. */
export function markOf(plant: RunDetails["plant"]): Mark | null {
  if (plant === "simulated") return null;
  return plant === "emulated" ? "emulated" : "real";
}
