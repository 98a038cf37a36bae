/** Outcome of a request whose answer was lost: polls the server until it is known. */
import { signal } from "@preact/signals";
import { setCallStatus } from "./calls";
import { NotExecutedError, RefusedError, type UnansweredError } from "./errors";
import { call } from "./operations";
import type { OutcomeState } from "./types";

/** asking: not yet known; carriedOut: the server has executed the request. */
type CommandStatus = "asking" | "carriedOut" | null;
export const commandStatus = signal<CommandStatus>(null);

const POLL_INTERVAL_MS = 500;
const MAX_POLL_MS = 60_000;
const SHOWN_MS = 8000;

const wait = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));

let pendingCount = 0;

function setStatus(next: CommandStatus): void {
  commandStatus.value = next;
  if (next === "carriedOut") {
    setTimeout(() => {
      if (commandStatus.peek() === next) commandStatus.value = null;
    }, SHOWN_MS);
  }
}

/**
 * Resolve if the request was executed. Throws `NotExecutedError` if it was not, and the
 * `UnansweredError` itself if the outcome is still unknown after a minute.
 */
export async function awaitOutcome(unanswered: UnansweredError): Promise<void> {
  pendingCount++;
  setStatus("asking");
  try {
    const status = await pollOutcome(unanswered);
    if (unanswered.call !== null) setCallStatus(unanswered.call, status);
    if (status === null || status >= 400) throw new NotExecutedError(status);
    setStatus("carriedOut");
  } finally {
    pendingCount--;
    if (pendingCount === 0 && commandStatus.peek() === "asking") setStatus(null);
  }
}

/** Status of its answer; null if the request never reached the server. */
async function pollOutcome(unanswered: UnansweredError): Promise<number | null> {
  const endMs = performance.now() + MAX_POLL_MS;
  let unknownCount = 0;
  while (performance.now() < endMs) {
    const outcome = await queryOutcome(unanswered.request ?? "");
    if (outcome?.outcome === "carried_out" || outcome?.outcome === "refused") return outcome.status;
    const sinceS = (performance.now() - unanswered.sentMs) / 1000;
    if (outcome?.outcome === "unknown" && outcome.known_for_s < sinceS) break;
    // Query twice: the request may arrive after the first query over another connection.
    unknownCount = outcome?.outcome === "unknown" ? unknownCount + 1 : 0;
    if (unknownCount === 2) return null;
    await wait(POLL_INTERVAL_MS);
  }
  throw unanswered;
}

async function queryOutcome(key: string): Promise<OutcomeState | null> {
  try {
    return await call("get", "/requests/{key}", { path: { key } });
  } catch (error) {
    if (error instanceof RefusedError) throw error;
    return null;
  }
}
