/** The plant of a session or a run: simulated, with its non-ideal effects, or an emulated or real bench. */
import type { BenchState, Effects, EffectsRequest, RunDetails } from "../api/types";

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

// What separates the simulation from a bench: the effects, and three ways to choose among them.

export const EFFECTS = [
  "encoders",
  "estimation",
  "friction",
  "current_lag",
  "noise",
  "gravity",
] as const;
export type Effect = (typeof EFFECTS)[number];
export type Preset = "ideal" | "rig" | "full";

const RIG: EffectsRequest = { encoders: {}, estimation: {}, delay_samples: 1 };
export const PRESETS: Record<Preset, EffectsRequest> = {
  ideal: {},
  rig: RIG,
  full: { ...RIG, friction: {}, current_lag: {}, noise: {}, gravity: {} },
};
const NAMES = Object.keys(PRESETS) as Preset[];

/** The choice that switches on just these effects, whatever their values; null for none of them. */
export function presetOf(effects: Effects): Preset | null {
  if (!effects.torque_limits) return null;
  const isThis = (name: Preset) =>
    effects.delay_samples === (PRESETS[name].delay_samples ?? 0) &&
    EFFECTS.every((effect) => Boolean(effects[effect]) === effect in PRESETS[name]);
  return NAMES.find(isThis) ?? null;
}
