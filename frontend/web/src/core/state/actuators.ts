/** The actuators of the lab, as each describes itself. */
import { signal } from "@preact/signals";
import { readActuators } from "../api/actuators";
import type { ActuatorParameters, ActuatorRow } from "../api/types";

const RETRY_MS = 2000;

/** The actuator of the paper; parameters that name no actuator are of it. */
export const SVSA = "svsa";

/** null until the server has answered. */
export const actuators = signal<readonly ActuatorRow[] | null>(null);

/** Read them when the page opens, once. */
export async function openActuators(): Promise<void> {
  try {
    actuators.value = await readActuators();
  } catch {
    setTimeout(() => void openActuators(), RETRY_MS);
  }
}

export const nameOfActuator = ({ mechanism }: ActuatorParameters): string =>
  typeof mechanism === "string" ? mechanism : SVSA;

export const describeActuator = (name: string): ActuatorRow | undefined =>
  actuators.value?.find((one) => one.name === name);

/** All parameters, as a request takes them. */
export function patchOf({ mechanism: _, ...values }: ActuatorParameters): ActuatorParameters {
  return values;
}
