/** The requests of this page that change something, oldest first. */
import { signal } from "@preact/signals";

export interface Call {
  id: number;
  method: string;
  /** Path below api/v1/, with the query. */
  path: string;
  body: unknown;
  /** Status of the answer; null if no answer came and the outcome is unknown. */
  status: number | null;
  /** Session time at which the request took effect, s, if the answer contains it. */
  timeS: number | null;
}

const MAX_CALLS = 200;
/** Requests with secrets of the lab are never shown. */
const SECRET_PATHS = ["login", "join", "rejoin"];
/** Read-only requests of interactive input, which are not shown: their path's beginning or end. */
const PREVIEW_PREFIX = "references/";
const PREDICTION_SUFFIX = "/bench/endurance";

export const calls = signal<readonly Call[]>([]);
let lastId = 0;

function readTime(answer: unknown): number | null {
  const time = (answer as { time_s?: unknown } | null)?.time_s;
  return typeof time === "number" ? time : null;
}

/** Log a call and return its number; read-only calls are not logged. */
export function logCall(
  method: string,
  path: string,
  body: unknown,
  status: number | null,
  answer: unknown = null,
): number | null {
  if (method === "get" || SECRET_PATHS.includes(path) || path.startsWith(PREVIEW_PREFIX))
    return null;
  if (path.endsWith(PREDICTION_SUFFIX)) return null;
  return addCall({ method, path, body, status, timeS: readTime(answer) });
}

/** Set the outcome of a call whose answer was lost; null if it never reached the server. */
export function setCallStatus(id: number, status: number | null): void {
  calls.value = calls.peek().map((call) => (call.id === id ? { ...call, status } : call));
}

/** Log a file that the browser downloads without `fetch`. */
export function logDownload(path: string): void {
  addCall({ method: "get", path, body: undefined, status: 200, timeS: null });
}

function addCall(call: Omit<Call, "id">): number {
  lastId += 1;
  calls.value = [...calls.peek(), { id: lastId, ...call }].slice(-MAX_CALLS);
  return lastId;
}

export function clearCalls(): void {
  calls.value = [];
}
