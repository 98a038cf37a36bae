/** What this page asked of the server, oldest first: every call that changes something. */
import { signal } from "@preact/signals";

export interface Call {
  id: number;
  method: string;
  /** Below api/v1/, with its query. */
  path: string;
  body: unknown;
  /** Null where the server was not reached. */
  status: number | null;
  /** Session time at which it held, where the answer tells it, s. */
  timeS: number | null;
}

const MOST_CALLS = 200;
/** What carries the lab's secret is shown nowhere. */
const SECRET_PATH = "login";

export const calls = signal<readonly Call[]>([]);
let lastId = 0;

function readTime(answer: unknown): number | null {
  const time = (answer as { time_s?: unknown } | null)?.time_s;
  return typeof time === "number" ? time : null;
}

/** Notes a call; one that only reads is worth showing where the user asked for a file. */
export function noteCall(
  method: string,
  path: string,
  body: unknown,
  status: number | null,
  answer: unknown = null,
): void {
  if (method === "get" || path === SECRET_PATH) return;
  addCall({ method, path, body, status, timeS: readTime(answer) });
}

/** Notes a file that the browser fetches by itself. */
export function noteDownload(path: string): void {
  addCall({ method: "get", path, body: undefined, status: 200, timeS: null });
}

function addCall(call: Omit<Call, "id">): void {
  lastId += 1;
  calls.value = [...calls.peek(), { id: lastId, ...call }].slice(-MOST_CALLS);
}

export function clearCalls(): void {
  calls.value = [];
}
