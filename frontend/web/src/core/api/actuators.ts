/** The actuators: their private sessions and datasheets. */
import { call } from "./operations";
import { API, WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";

export type Datasheet = components["schemas"]["DatasheetState"];

export const readActuators = () => call("get", "/actuators", {});
export const readActuator = (name: string) => call("get", "/actuators/{name}", { path: { name } });
/** The first session of an actuator compiles its control loop. */
export const openActuator = (actuator: string) =>
  call("post", "/sessions", { body: { from: "actuator", actuator } }, WORK_TIMEOUT_MS);
/** The first request measures it. */
export const readDatasheet = (actuator: string) =>
  call("get", "/actuators/{name}/datasheet", { path: { name: actuator } }, WORK_TIMEOUT_MS);
export const datasheetAddress = (actuator: string, format: "pdf" | "json"): string =>
  new URL(`actuators/${actuator}/datasheet?format=${format}`, API).href;
