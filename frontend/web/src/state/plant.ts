/** What a session or a run came from: a simulation, the emulated rig, or metal. */
import type { RunDetails } from "../api/types";

export type Mark = "emulated" | "real";

/** The mark of a recorded run; a simulation needs none. */
export function markOf(plant: RunDetails["plant"]): Mark | null {
  if (plant === "simulated") return null;
  return plant === "emulated" ? "emulated" : "real";
}
