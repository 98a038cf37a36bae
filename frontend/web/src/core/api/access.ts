/** Who one is in this lab, how one comes in, and what the class does. */
import { request } from "./request";
import type { components } from "./schema";

type Schemas = components["schemas"];

export type Access = Schemas["AccessState"];
export type ClassState = Schemas["ClassState"];
export type ClassCode = Schemas["ClassCode"];
export type AuditPage = Schemas["AuditPage"];
export type AuditLine = Schemas["AuditLine"];
type Broadcast = Schemas["BroadcastState"];

/** Without it, a client that gives up early would join the class twice. */
const COMING_IN_MS = 30_000;
const comeIn = (path: string, body: object) => request("post", path, body, COMING_IN_MS);

export const readAccess = () => request("get", "access") as Promise<Access>;
/** The lab's secret, or the instructor token of its class. */
export const login = (secret: string) => comeIn("login", { secret });
export const join = (name: string, code: string) =>
  comeIn("join", { name, code, role: "operator" }) as Promise<Schemas["JoinState"]>;
/** As who one was, by one's own rejoin code. */
export const comeBack = (code: string) => comeIn("rejoin", { code }) as Promise<Access>;
export const renewRejoinCode = () =>
  request("post", "rejoin-code") as Promise<Schemas["RejoinCode"]>;
export const leave = () => request("post", "leave");
export const createToken = () =>
  request("post", "tokens", { role: "operator" }) as Promise<Schemas["TokenState"]>;
export const readClass = () => request("get", "class") as Promise<ClassState>;
export interface AuditWish {
  person: string;
  kind: string;
  onlyRefused: boolean;
  page: number;
  /** Of the first page, which the others go on from; empty for the newest. */
  until: string;
}
/** Reading it all takes a worker some time. */
const LONG_WAIT_MS = 60_000;
export function readAudit({ person, kind, onlyRefused, page, until }: AuditWish) {
  const query = new URLSearchParams({ person, kind, until, page: String(page) });
  if (onlyRefused) query.set("refused", "true");
  return request("get", `class/audit?${query}`, undefined, LONG_WAIT_MS) as Promise<AuditPage>;
}
const personPath = (id: string) => `class/people/${encodeURIComponent(id)}`;
const setRemoved = (id: string, removed: boolean) => request("patch", personPath(id), { removed });
export const removePerson = (id: string) => setRemoved(id, true);
export const restorePerson = (id: string) => setRemoved(id, false);
export const renewCode = () => request("post", "class/code") as Promise<ClassCode>;
export const broadcast = () => request("post", "class/broadcast") as Promise<Broadcast>;
export const endSession = (name: string) =>
  request("delete", `sessions/${encodeURIComponent(name)}`);
