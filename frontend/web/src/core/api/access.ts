/** The user's identity, joining the lab or class, and the activity of the class. */
import { call } from "./operations";
import { WORK_TIMEOUT_MS } from "./request";
import type { components } from "./schema";

type Schemas = components["schemas"];

export type Access = Schemas["AccessState"];
export type ClassState = Schemas["ClassState"];
export type ClassCode = Schemas["ClassCode"];
export type AuditPage = Schemas["AuditPage"];
export type AuditLine = Schemas["AuditLine"];

/** Without it, a client that times out early would join the class twice. */
const LOGIN_TIMEOUT_MS = 30_000;

export const readAccess = () => call("get", "/access", {});
/** The lab's secret, or the instructor token of its class. */
export const login = (secret: string) =>
  call("post", "/login", { body: { secret } }, LOGIN_TIMEOUT_MS);
export const join = (name: string, code: string) =>
  call("post", "/join", { body: { name, code, role: "operator" } }, LOGIN_TIMEOUT_MS);
/** Log in again with the user's rejoin code. */
export const rejoin = (code: string) =>
  call("post", "/rejoin", { body: { code } }, LOGIN_TIMEOUT_MS);
export const renewRejoinCode = () => call("post", "/rejoin-code", {});
export const leave = () => call("post", "/leave", {});
export const createToken = () => call("post", "/tokens", { body: { role: "operator" } });
export const readClass = () => call("get", "/class", {});
export interface AuditQuery {
  person: string;
  kind: string;
  onlyRefused: boolean;
  page: number;
  /** Cursor of the first page, from which the others continue; empty for the newest entries. */
  until: string;
}
export function readAudit({ person, kind, onlyRefused, page, until }: AuditQuery) {
  const query = { person, kind, until, page, ...(onlyRefused && { refused: true }) };
  return call("get", "/class/audit", { query }, WORK_TIMEOUT_MS);
}
export type Member = Schemas["Member"];
/** Every member, for the instructor. */
export const readMembers = () => call("get", "/class/people", {});
const setRemoved = (person: string, removed: boolean) =>
  call("patch", "/class/people/{person}", { path: { person }, body: { removed } });
export const renewRejoinCodeOf = (person: string) =>
  call("post", "/class/people/{person}/rejoin-code", { path: { person } });
export const removePerson = (id: string) => setRemoved(id, true);
export const restorePerson = (id: string) => setRemoved(id, false);
export const renewCode = () => call("post", "/class/code", {});
export const broadcast = () => call("post", "/class/broadcast", {});
export const endSession = (session: string) =>
  call("delete", "/sessions/{session}", { path: { session } });
