/** The actuators: their private sessions and datasheets. */
import { API, request, WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";
import type { ActuatorRow, SessionState } from "./types";

export type Datasheet = components["schemas"]["DatasheetState"];

export const readActuators = () => request("get", "actuators") as Promise<ActuatorRow[]>;
export const readActuator = (name: string) =>
  request("get", `actuators/${name}`) as Promise<ActuatorRow>;
/** The first session of an actuator compiles its control loop. */
export const openActuator = (actuator: string) =>
  request(
    "post",
    "sessions",
    { from: "actuator", actuator },
    WORK_TIMEOUT_MS,
  ) as Promise<SessionState>;
/** The first request measures it. */
export const readDatasheet = (actuator: string) =>
  request(
    "get",
    `actuators/${actuator}/datasheet`,
    undefined,
    WORK_TIMEOUT_MS,
  ) as Promise<Datasheet>;
export const datasheetAddress = (actuator: string, format: "pdf" | "json"): string =>
  new URL(`actuators/${actuator}/datasheet?format=${format}`, API).href;
