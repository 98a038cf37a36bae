/** The plant of a session or a run: simulated or a bench and the loads on it. */

import { signal } from "@preact/signals";
import type { BenchState, Load, LoadRow, RunDetails, SessionState } from "../api/types";
import { SVSA } from "./actuators";

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

export type WeightForm = "paper" | "mass" | "torque";

/** `paper`: 2 N·m on all three channels; `torque`: the default load of another actuator than the SVSA; `mass`: a mass with inertia and gravity, as large as the library's default. */
export const chosenForm = signal<WeightForm | null>(null);

/** The form of the next 3 kg: a mass on a bench, whose stiffness motor does not hold the paper's torques; on a real one always. */
export function formOfNext({ actuator, bench }: SessionState): WeightForm {
  if (actuator.name !== SVSA) return "torque";
  return isRealBench(bench) ? "mass" : (chosenForm.value ?? (bench === null ? "paper" : "mass"));
}

/** The load that the button adds: 3 kg, or the default load of another actuator than the SVSA. */
export function nextWeight(state: SessionState): Load {
  const kind = formOfNext(state);
  if (kind !== "torque") return { kind };
  const { start_s: _, ...load } = state.actuator.load;
  return load;
}

/** One of which it is not known yet whether it is emulated counts as real. */
export const isRealBench = (bench: BenchState | null): boolean =>
  bench !== null && bench.emulated !== true;

export function isWeight({ actuator }: SessionState, { load }: LoadRow): boolean {
  if (actuator.name === SVSA) return load.kind === "paper" || load.kind === "mass";
  return load.kind === "constant" && load.torque_nm.join() === actuator.load.torque_nm.join();
}

export const hungWeights = (state: SessionState): LoadRow[] =>
  state.loads.filter((row) => row.active && isWeight(state, row));

/** When the next scheduled weight comes, session time in s; null when none is scheduled. */
export function nextWeightAt(state: SessionState): number | null {
  const starts = state.loads
    .filter((row) => !row.active && isWeight(state, row) && row.start_s > state.time_s)
    .map((row) => row.start_s);
  return starts.length === 0 ? null : Math.min(...starts);
}

/** Loads that act or will act. */
export const presentLoads = (state: SessionState): LoadRow[] =>
  state.loads.filter((row) => row.active || row.start_s > state.time_s);
