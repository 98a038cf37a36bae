/** Requests to the server, with the id by which the server recognises this tab. */
import { logCall } from "./calls";
import { LockedError, RefusedError, UnansweredError } from "./errors";
import type { Method, Refusal } from "./types";

const STORAGE_KEY = "svsa.client";

/** 128 random bits as text. */
function randomId(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** Read the id that a reload keeps; a duplicated tab finds none. */
function takeStoredId(): string | null {
  try {
    const storedId = sessionStorage.getItem(STORAGE_KEY);
    sessionStorage.removeItem(STORAGE_KEY);
    return storedId;
  } catch {
    return null;
  }
}

export const client = takeStoredId() ?? randomId();

window.addEventListener("pagehide", () => {
  try {
    sessionStorage.setItem(STORAGE_KEY, client);
  } catch {
    // Without storage the tab is a new client after each reload.
  }
});
window.addEventListener("pageshow", (event) => {
  if (event.persisted) takeStoredId();
});

// One request to the server, and the session that the page shows.

export const API = new URL("api/v1/", document.baseURI);
const SHARED_SESSION = "lab";
/** The session of this page: the shared one, or the private one in the address. */
export const sessionName = new URLSearchParams(location.search).get("session") ?? SHARED_SESSION;
export const isPrivate = sessionName !== SHARED_SESSION;
const CLIENT_HEADER = "SVSA-Client";
/** Id by which the server finds a changing request if its answer is lost. */
const REQUEST_HEADER = "Idempotency-Key";
export const DEFAULT_TIMEOUT_MS = 6000;
/**
 * For work in a process of low priority, which first has to start or to compile: minutes on a busy
 * machine. A request that is given up and sent again would wait behind its own earlier work.
 */
export const WORK_TIMEOUT_MS = 300_000;

/** timeoutMs: longest time without a received byte. */
export async function request(
  method: Method,
  path: string,
  body?: unknown,
  timeoutMs = DEFAULT_TIMEOUT_MS,
  extraHeaders: Readonly<Record<string, string>> = {},
  hasKey = false,
): Promise<unknown> {
  const requestId = hasKey ? randomId() : null;
  const headers: Record<string, string> = { ...extraHeaders, [CLIENT_HEADER]: client };
  if (requestId !== null) headers[REQUEST_HEADER] = requestId;
  // The only bodies of text are CSV files.
  const isCsv = typeof body === "string";
  if (body !== undefined) headers["Content-Type"] = isCsv ? "text/csv" : "application/json";
  const sentMs = performance.now();
  let response: Response;
  let answer: unknown;
  const silence = new AbortController();
  let heardMs = sentMs;
  const listen = (waitMs: number) =>
    AbortSignal.timeout(waitMs).addEventListener("abort", ({ target }) => {
      const leftMs = Math.ceil(heardMs + timeoutMs - performance.now());
      if (leftMs > 0) listen(leftMs);
      else silence.abort((target as AbortSignal).reason);
    });
  listen(timeoutMs);
  try {
    response = await fetch(new URL(path, API), {
      method: method.toUpperCase(),
      cache: "no-store",
      headers,
      ...(body !== undefined && { body: isCsv ? body : JSON.stringify(body) }),
      signal: silence.signal,
    });
    answer = parse(
      await readText(response, () => {
        heardMs = performance.now();
      }),
    );
  } catch (cause) {
    const call = logCall(method, path, body, null);
    throw new UnansweredError(cause, requestId, sentMs, call);
  } finally {
    heardMs = Number.NEGATIVE_INFINITY;
  }
  logCall(method, path, body, response.status, answer);
  if (response.ok) return answer;
  throw buildRefusal(response, answer);
}

/** Read an answer part by part: on a slow link a long one takes longer than the time limit. */
async function readText(response: Response, onPart: () => void): Promise<string> {
  if (!response.body) return response.text();
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    onPart();
    text += part.value;
  }
  return text;
}

/** Reason why the server rejected a request. */
export const readRefusal = async (response: Response): Promise<Error> =>
  buildRefusal(response, parse(await response.text()));

function buildRefusal(response: Response, answer: unknown): Error {
  const refusal = answer as Partial<Refusal> | null;
  const message = refusal?.detail ?? `${response.status} ${response.statusText}`;
  if (response.status === 401) return new LockedError(message);
  return new RefusedError(response.status, message, refusal?.violations ?? []);
}

function parse(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return null;
  }
}
