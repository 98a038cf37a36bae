/** What this page asked of the server, oldest first: every call that changes something. */
import { signal } from "@preact/signals";

export interface Call {
  id: number;
  method: string;
  /** Below api/v1/, with its query. */
  path: string;
  body: unknown;
  /** Null where no answer came, and nothing else is known. */
  status: number | null;
  /** Session time at which it held, where the answer tells it, s. */
  timeS: number | null;
}

const MAX_CALLS = 200;
/** What carries a secret of the lab is shown nowhere. */
const SECRET_PATHS = ["login", "join"];
/** What is only looked at, at every key that is pressed: where its path begins, or ends. */
const LOOKED_AT = "references/";
const PREDICTION = "/bench/endurance";

export const calls = signal<readonly Call[]>([]);
let lastId = 0;

function readTime(answer: unknown): number | null {
  const time = (answer as { time_s?: unknown } | null)?.time_s;
  return typeof time === "number" ? time : null;
}

/** Notes a call, and says under which number; one that only reads is not worth showing. */
export function noteCall(
  method: string,
  path: string,
  body: unknown,
  status: number | null,
  answer: unknown = null,
): number | null {
  if (method === "get" || SECRET_PATHS.includes(path) || path.startsWith(LOOKED_AT)) return null;
  if (path.endsWith(PREDICTION)) return null;
  return addCall({ method, path, body, status, timeS: readTime(answer) });
}

/** Outcome of a call whose answer was lost; null where it never came to the server. */
export function answerCall(id: number, status: number | null): void {
  calls.value = calls.peek().map((call) => (call.id === id ? { ...call, status } : call));
}

/** Records a file that the browser downloads without `fetch`. */
export function noteDownload(path: string): void {
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
