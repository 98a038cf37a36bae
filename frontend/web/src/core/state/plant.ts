/** The plant of a session or a run: simulated, with its non-ideal effects, or an emulated or real bench. */
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

// What separates the simulation from a bench: the effects.

export const EFFECTS = [
  "encoders",
  "estimation",
  "friction",
  "current_lag",
  "noise",
  "gravity",
] as const;
export type Effect = (typeof EFFECTS)[number];
