/** The plant of a session or a run: simulated or a bench, and its loads. */

import { computed, signal } from "@preact/signals";
import type { BenchState, Load, LoadRow, RunDetails, SessionState } from "../api/types";
import { SVSA } from "./actuators";
import { armOf } from "./joints";
import { session } from "./session";

export type PlantKind = "emulated" | "real" | "unknown";

/** Unknown for a bench until its bus has been read. */
export function plantKindOfBench({ emulated }: BenchState): PlantKind {
  if (emulated === null) return "unknown";
  return emulated ? "emulated" : "real";
}

export const bench = computed(() => session.value?.bench ?? null);

/** Null for a simulation, which needs no mark. */
export const plantKind = computed<PlantKind | null>(() =>
  bench.value === null ? null : plantKindOfBench(bench.value),
);

/** The mark of a recorded run; a simulation needs none. */
export function plantKindOfRun(plant: RunDetails["plant"]): PlantKind | null {
  if (plant === "simulated") return null;
  return plant === "emulated" ? "emulated" : "real";
}

// The 3 kg load: which of the session's loads it is, and the form of the next one.

export type WeightForm = "paper" | "mass" | "torque" | "tip";

/**
 * `paper`: 2 N·m on all three channels; `torque`: the default load of an actuator other than the
 * SVSA; `mass`: a mass with inertia and gravity, the library's default; `tip`: a mass at the tip of
 * an arm.
 */
export const chosenForm = signal<WeightForm | null>(null);

/** The mass that the button hangs at the tip of an arm, kg. */
export const tipMassKg = signal(0.1);

/**
 * The form of the next 3 kg: a mass on an emulated bench, whose stiffness motor cannot hold the
 * paper's torques; always a mass on a real one.
 */
export function nextWeightForm(state: SessionState): WeightForm {
  const { actuator, bench } = state;
  if (armOf(state) !== null) return "tip";
  if (actuator.name !== SVSA) return "torque";
  return isRealBench(bench) ? "mass" : (chosenForm.value ?? (bench === null ? "paper" : "mass"));
}

/** The load that the button adds: 3 kg, or the default load of an actuator other than the SVSA. */
export function nextWeight(state: SessionState): Load {
  const kind = nextWeightForm(state);
  if (kind === "tip") return { kind: "tip_mass", mass_kg: tipMassKg.value };
  if (kind !== "torque") return { kind };
  const { start_s: _, ...load } = state.actuator.load;
  return load;
}

/** A bench counts as real until it is known to be emulated. */
export const isRealBench = (bench: BenchState | null): boolean =>
  bench !== null && bench.emulated !== true;

export function isWeight(state: SessionState, { load }: LoadRow): boolean {
  const { actuator } = state;
  if (armOf(state) !== null) return load.kind === "tip_mass";
  if (actuator.name === SVSA) return load.kind === "paper" || load.kind === "mass";
  return load.kind === "constant" && load.torque_nm.join() === actuator.load.torque_nm.join();
}

export const activeWeights = (state: SessionState): LoadRow[] =>
  state.loads.filter((row) => row.active && isWeight(state, row));

/** The mass that hangs at the tip of an arm, kg; 0 without one. */
export const hungAtTip = (state: SessionState): number =>
  activeWeights(state).reduce(
    (sum, { load }) => sum + (load.kind === "tip_mass" ? load.mass_kg : 0),
    0,
  );

export const scheduledWeights = (state: SessionState): LoadRow[] =>
  state.loads.filter((row) => !row.active && isWeight(state, row) && row.start_s > state.time_s);

/** Time of the next scheduled weight, session time in s; null without one. */
export function nextWeightAt(state: SessionState): number | null {
  const starts = scheduledWeights(state).map((row) => row.start_s);
  return starts.length === 0 ? null : Math.min(...starts);
}

/** Loads that act or will act. */
export const currentLoads = (state: SessionState): LoadRow[] =>
  state.loads.filter((row) => row.active || row.start_s > state.time_s);
