/** The actuators of the lab with their descriptions. */
import { signal } from "@preact/signals";
import type { ActuatorParameters, ActuatorRow } from "../api/types";

/** The paper's actuator; parameters without the name of an actuator belong to it. */
export const SVSA = "svsa";

/** null until the server has answered. */
export const actuators = signal<readonly ActuatorRow[] | null>(null);

export const nameOfActuator = ({ mechanism }: ActuatorParameters): string =>
  typeof mechanism === "string" ? mechanism : SVSA;

export const describeActuator = (name: string): ActuatorRow | undefined =>
  actuators.value?.find((actuator) => actuator.name === name);

/** All parameters, as a request needs them. */
export function patchOf({ mechanism: _, ...values }: ActuatorParameters): ActuatorParameters {
  return values;
}
