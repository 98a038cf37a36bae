/** The exchangeable parts, except for laws, with the server's description of each kind. */
import { signal } from "@preact/signals";
import { putEffects, readKinds, type SessionRequest } from "../api/client";
import type { EffectRow, EffectsPreset, Kinds, ParameterRow } from "../api/types";
import { type Quantity, quantityOfSchema, schemaOfParameter } from "../schema";

const RETRY_MS = 2000;

export type Preset = EffectsPreset["name"];

/** null until the server has answered. */
export const kinds = signal<Kinds | null>(null);

/** Read them once, when the page opens. */
export async function openKinds(): Promise<void> {
  try {
    kinds.value = await readKinds();
  } catch {
    setTimeout(() => void openKinds(), RETRY_MS);
  }
}

/** Switch on the effects of a preset, with their default values. */
export const choosePreset =
  (name: Preset): SessionRequest =>
  async (edit) => {
    kinds.value ??= await readKinds();
    const preset = kinds.value.presets.find((candidate) => candidate.name === name);
    return putEffects(preset?.effects ?? {})(edit);
  };

const listNumbers = ({ value, parameters }: EffectRow): ParameterRow[] =>
  value === null ? parameters : [value];

/** The quantity of a path such as `noise.motor_std_rad`; null if no effect has it. */
export function effectQuantityOf(path: string): Quantity | null {
  const [name, effect] = path.split(".").reverse();
  const parameter = kinds.value?.effects
    .filter(
      (candidate) => effect === undefined || effect === "effects" || candidate.name === effect,
    )
    .flatMap(listNumbers)
    .find((row) => row.name === name);
  return parameter === undefined ? null : quantityOfSchema(schemaOfParameter(parameter));
}
