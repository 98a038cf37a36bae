/** The actuators: their private sessions and datasheets. */
import { API, request } from "./request";
import type { components } from "./schema";
import type { ActuatorRow, SessionState } from "./types";

export type Datasheet = components["schemas"]["DatasheetState"];

/** The first request measures it. */
const LONG_TIMEOUT_MS = 120_000;

export const readActuators = () => request("get", "actuators") as Promise<ActuatorRow[]>;
export const readActuator = (name: string) =>
  request("get", `actuators/${name}`) as Promise<ActuatorRow>;
export const openActuator = (actuator: string) =>
  request(
    "post",
    "sessions",
    { from: "actuator", actuator },
    LONG_TIMEOUT_MS,
  ) as Promise<SessionState>;
export const readDatasheet = (actuator: string) =>
  request(
    "get",
    `actuators/${actuator}/datasheet`,
    undefined,
    LONG_TIMEOUT_MS,
  ) as Promise<Datasheet>;
export const datasheetAddress = (actuator: string, format: "pdf" | "json"): string =>
  new URL(`actuators/${actuator}/datasheet?format=${format}`, API).href;
