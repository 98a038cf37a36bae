/** EMULATED or REAL BENCH, in words, beside what came from there. */
import type { RunDetails } from "../api/types";
import { text } from "../text/en";

export type Mark = "emulated" | "real";

/** The mark of a recorded run; a simulation needs none. */
export function markOf(plant: RunDetails["plant"]): Mark | null {
  if (plant === "simulated") return null;
  return plant === "emulated" ? "emulated" : "real";
}

export function PlantMark({ kind }: { kind: Mark | null }) {
  if (kind === null) return null;
  return (
    <strong class={`corner-mark is-${kind}`} data-over-picture>
      {text.mark[kind].name}
    </strong>
  );
}
