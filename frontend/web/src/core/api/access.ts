/** The user's identity, joining the lab or class, and the activity of the class. */
import { request, WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";

type Schemas = components["schemas"];

export type Access = Schemas["AccessState"];
export type ClassState = Schemas["ClassState"];
export type ClassCode = Schemas["ClassCode"];
export type AuditPage = Schemas["AuditPage"];
export type AuditLine = Schemas["AuditLine"];
type Broadcast = Schemas["BroadcastState"];

/** Without it, a client that times out early would join the class twice. */
const LOGIN_TIMEOUT_MS = 30_000;
const postLogin = (path: string, body: object) => request("post", path, body, LOGIN_TIMEOUT_MS);

export const readAccess = () => request("get", "access") as Promise<Access>;
/** The lab's secret, or the instructor token of its class. */
export const login = (secret: string) => postLogin("login", { secret });
export const join = (name: string, code: string) =>
  postLogin("join", { name, code, role: "operator" }) as Promise<Schemas["JoinState"]>;
/** Log in again with the user's rejoin code. */
export const rejoin = (code: string) => postLogin("rejoin", { code }) as Promise<Access>;
export const renewRejoinCode = () =>
  request("post", "rejoin-code") as Promise<Schemas["RejoinCode"]>;
export const leave = () => request("post", "leave");
export const createToken = () =>
  request("post", "tokens", { role: "operator" }) as Promise<Schemas["TokenState"]>;
export const readClass = () => request("get", "class") as Promise<ClassState>;
export interface AuditQuery {
  person: string;
  kind: string;
  onlyRefused: boolean;
  page: number;
  /** Cursor of the first page, from which the others continue; empty for the newest entries. */
  until: string;
}
export function readAudit({ person, kind, onlyRefused, page, until }: AuditQuery) {
  const query = new URLSearchParams({ person, kind, until, page: String(page) });
  if (onlyRefused) query.set("refused", "true");
  return request("get", `class/audit?${query}`, undefined, WORK_TIMEOUT_MS) as Promise<AuditPage>;
}
export type Member = Schemas["Member"];
/** Every member, for the instructor. */
export const readMembers = () => request("get", "class/people") as Promise<Member[]>;
const personPath = (id: string) => `class/people/${encodeURIComponent(id)}`;
const setRemoved = (id: string, removed: boolean) => request("patch", personPath(id), { removed });
export const renewRejoinCodeOf = (id: string) =>
  request("post", `${personPath(id)}/rejoin-code`) as Promise<Schemas["RejoinCode"]>;
export const removePerson = (id: string) => setRemoved(id, true);
export const restorePerson = (id: string) => setRemoved(id, false);
export const renewCode = () => request("post", "class/code") as Promise<ClassCode>;
export const broadcast = () => request("post", "class/broadcast") as Promise<Broadcast>;
export const endSession = (name: string) =>
  request("delete", `sessions/${encodeURIComponent(name)}`);
