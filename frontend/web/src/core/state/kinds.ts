/** The exchangeable parts, except for laws, with the server's description of each kind. */
import { signal } from "@preact/signals";
import { putEffects, readKinds, type SessionRequest } from "../api/client";
import type { EffectRow, EffectsPreset, FormField, Kinds, ParameterRow } from "../api/types";
import type { Quantity } from "../quantities";
import { DEGREES_PER_RADIAN } from "../units";

const RETRY_MS = 2000;
const MILLI_LIMIT = 0.1;

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

type Described = Pick<ParameterRow, "symbol" | "meaning" | "unit" | "low" | "high">;

/** Label, unit, bounds and factor on screen: angles in degrees, small numbers in thousandths. */
export function quantityOfParameter(parameter: Described): Quantity {
  const { low, high } = parameter;
  const quantity = nameQuantity(parameter);
  const { factor = 1 } = quantity;
  return {
    ...quantity,
    ...(low !== null && { min: low * factor }),
    ...(high !== null && { max: high * factor }),
  };
}

function nameQuantity({ symbol, meaning, unit, high }: Described): Quantity {
  const label = symbol || meaning;
  if (unit === "1" || unit === "") return { label, unit: "" };
  const isSmall = (unit === "s" || unit === "rad") && high !== null && high <= MILLI_LIMIT;
  if (isSmall) return { label, unit: `m${unit}`, factor: 1e3 };
  if (unit === "rad" || unit === "rad·s") {
    return { label, unit: unit.replace("rad", "deg"), factor: DEGREES_PER_RADIAN };
  }
  return { label, unit };
}

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
  return parameter === undefined ? null : quantityOfParameter(parameter);
}

/** Initial values of the fields of a form, by name, in the units on screen. */
export const initialValues = (form: readonly FormField[]): Record<string, number> =>
  Object.fromEntries(
    form.map(({ parameter, first }) => {
      const { factor = 1 } = quantityOfParameter(parameter);
      return [parameter.name, first * factor];
    }),
  );

/** Values of a form in SI. */
export const readForm = (
  form: readonly FormField[],
  values: Readonly<Record<string, number>>,
): Record<string, number> =>
  Object.fromEntries(
    form.map(({ parameter: { name }, parameter }) => [
      name,
      (values[name] as number) / (quantityOfParameter(parameter).factor ?? 1),
    ]),
  );
