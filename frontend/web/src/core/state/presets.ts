/** The presets of non-ideal effects, as the server reports them. */
import { signal } from "@preact/signals";
import { putEffects, readPresets } from "../api/client";
import type { EffectsPreset, SessionState } from "../api/types";

const RETRY_MS = 2000;

export type Preset = EffectsPreset["name"];

const presets = signal<readonly EffectsPreset[]>([]);

/** Switch on the effects of a preset, with their default values. */
export async function choosePreset(name: Preset): Promise<SessionState> {
  if (presets.value.length === 0) presets.value = await readPresets();
  const preset = presets.value.find((one) => one.name === name);
  return putEffects(preset?.effects ?? {});
}

/** Read the presets when the page opens, once. */
export async function openPresets(): Promise<void> {
  try {
    presets.value = await readPresets();
  } catch {
    setTimeout(() => void openPresets(), RETRY_MS);
  }
}
