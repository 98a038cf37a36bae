/** What separates the simulation from a bench: the effects, and three ways to choose among them. */
import type { Effects, EffectsRequest } from "../api/types";

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
