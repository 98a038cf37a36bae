/** The plant of a session or a run: simulated or a bench and the loads on it. */

import { signal } from "@preact/signals";
import type { BenchState, Load, LoadRow, RunDetails, SessionState } from "../api/types";

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

// The 3 kg load: which of the session's loads it is, and the form in which it is hung next.

export type WeightForm = "paper" | "mass";

/** `paper`: 2 N·m on all three channels; `mass`: a mass with inertia and gravity, as large as the library's default. */
export const chosenForm = signal<WeightForm | null>(null);

/** The form of the next 3 kg: a mass on a bench, whose stiffness motor does not hold the paper's torques; on a real one always. */
export const formOfNext = (bench: BenchState | null): WeightForm =>
  isRealBench(bench) ? "mass" : (chosenForm.value ?? (bench === null ? "paper" : "mass"));

export const nextWeight = (bench: BenchState | null): Load => ({ kind: formOfNext(bench) });

/** One of which it is not known yet whether it is emulated counts as real. */
export const isRealBench = (bench: BenchState | null): boolean =>
  bench !== null && bench.emulated !== true;

export const isWeight = ({ load }: LoadRow): boolean =>
  load.kind === "paper" || load.kind === "mass";

export const hungWeights = (state: SessionState): LoadRow[] =>
  state.loads.filter((row) => row.active && isWeight(row));

/** When the next scheduled weight comes, session time in s; null when none is scheduled. */
export function nextWeightAt(state: SessionState): number | null {
  const starts = state.loads
    .filter((row) => !row.active && isWeight(row) && row.start_s > state.time_s)
    .map((row) => row.start_s);
  return starts.length === 0 ? null : Math.min(...starts);
}

/** Loads that act or will act. */
export const presentLoads = (state: SessionState): LoadRow[] =>
  state.loads.filter((row) => row.active || row.start_s > state.time_s);
