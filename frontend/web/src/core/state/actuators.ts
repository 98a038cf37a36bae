/** The actuators of the lab, as each describes itself. */
import { signal } from "@preact/signals";
import type { ActuatorParameters, ActuatorRow } from "../api/types";

/** The actuator of the paper; parameters that name no actuator are of it. */
export const SVSA = "svsa";

/** null until the server has answered. */
export const actuators = signal<readonly ActuatorRow[] | null>(null);

export const nameOfActuator = ({ mechanism }: ActuatorParameters): string =>
  typeof mechanism === "string" ? mechanism : SVSA;

export const describeActuator = (name: string): ActuatorRow | undefined =>
  actuators.value?.find((one) => one.name === name);

/** All parameters, as a request takes them. */
export function patchOf({ mechanism: _, ...values }: ActuatorParameters): ActuatorParameters {
  return values;
}
