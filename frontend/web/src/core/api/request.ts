/** One request to the server, with the id by which the server recognises this tab. */
import { noteCall } from "./calls";
import { LockedError, RefusedError, UnansweredError } from "./errors";
import type { Method, Refusal } from "./types";

const KEY = "svsa.client";

/** 128 random bits as text. */
function drawText(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** What a reload keeps; a tab that was made from this one by duplication finds nothing. */
function takeKept(): string | null {
  try {
    const kept = sessionStorage.getItem(KEY);
    sessionStorage.removeItem(KEY);
    return kept;
  } catch {
    return null;
  }
}

export const client = takeKept() ?? drawText();

window.addEventListener("pagehide", () => {
  try {
    sessionStorage.setItem(KEY, client);
  } catch {
    // A tab that keeps nothing is another client after a reload.
  }
});
window.addEventListener("pageshow", (event) => {
  if (event.persisted) takeKept();
});

// One request to the server, and which session the page is about.

export const API = new URL("api/v1/", document.baseURI);
const SHARED = "lab";
/** The session that this page shows: the shared one, or the private one that its address names. */
export const sessionName = new URLSearchParams(location.search).get("session") ?? SHARED;
export const isPrivate = sessionName !== SHARED;
const CLIENT_HEADER = "SVSA-Client";
/** What the server knows a changing request by, should its answer be lost. */
const REQUEST_HEADER = "Idempotency-Key";
export const LONGEST_WAIT_MS = 6000;

export async function request(
  method: Method,
  path: string,
  body?: unknown,
  waitMs = LONGEST_WAIT_MS,
  more: Readonly<Record<string, string>> = {},
): Promise<unknown> {
  const name = method === "get" ? null : drawText();
  const headers: Record<string, string> = { ...more, [CLIENT_HEADER]: client };
  if (name !== null) headers[REQUEST_HEADER] = name;
  if (body !== undefined) headers["Content-Type"] = "application/json";
  const sentMs = performance.now();
  let response: Response;
  let answer: unknown;
  try {
    response = await fetch(new URL(path, API), {
      method: method.toUpperCase(),
      cache: "no-store",
      headers,
      ...(body !== undefined && { body: JSON.stringify(body) }),
      signal: AbortSignal.timeout(waitMs),
    });
    answer = parse(await response.text());
  } catch (cause) {
    const call = noteCall(method, path, body, null);
    throw new UnansweredError(cause, name, sentMs, call);
  }
  noteCall(method, path, body, response.status, answer);
  if (response.ok) return answer;
  throw buildRefusal(response, answer);
}

/** Why the server did not answer with what was asked for. */
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
