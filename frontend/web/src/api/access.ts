/** Who one is in this lab, how one comes in, and what the class does. */
import { request } from "./request";
import type { components } from "./schema";

type Schemas = components["schemas"];

export type Access = Schemas["AccessState"];
export type ClassState = Schemas["ClassState"];
export type ClassCode = Schemas["ClassCode"];
export type Broadcast = Schemas["BroadcastState"];

export const readAccess = () => request("get", "access") as Promise<Access>;
/** The lab's secret, or the instructor token of its class. */
export const login = (secret: string) => request("post", "login", { secret });
export const join = (name: string, code: string) =>
  request("post", "join", { name, code, role: "operator" }) as Promise<Access>;
export const leave = () => request("post", "leave");
export const createToken = () =>
  request("post", "tokens", { role: "operator" }) as Promise<Schemas["TokenState"]>;
export const readClass = () => request("get", "class") as Promise<ClassState>;
export const renewCode = () => request("post", "class/code") as Promise<ClassCode>;
export const broadcast = () => request("post", "class/broadcast") as Promise<Broadcast>;
export const endSession = (name: string) =>
  request("delete", `sessions/${encodeURIComponent(name)}`);
