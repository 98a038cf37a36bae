/** The actuators: private sessions and datasheets of them. */
import { API, request } from "./request";
import type { components } from "./schema";
import type { ActuatorRow, SessionState } from "./types";

export type Datasheet = components["schemas"]["DatasheetState"];

/** It is measured at the first request. */
const LONG_WAIT_MS = 120_000;

export const readActuators = () => request("get", "actuators") as Promise<ActuatorRow[]>;
export const openActuator = (actuator: string) =>
  request(
    "post",
    "sessions",
    { from: "actuator", actuator },
    LONG_WAIT_MS,
  ) as Promise<SessionState>;
export const readDatasheet = (actuator: string) =>
  request("get", `actuators/${actuator}/datasheet`, undefined, LONG_WAIT_MS) as Promise<Datasheet>;
export const datasheetAddress = (actuator: string, format: "pdf" | "json"): string =>
  new URL(`actuators/${actuator}/datasheet?format=${format}`, API).href;
