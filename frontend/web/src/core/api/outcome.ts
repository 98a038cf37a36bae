/** Outcome of a request whose answer did not come: the server is asked until it says. */
import { signal } from "@preact/signals";
import { answerCall } from "./calls";
import { NotCarriedOutError, RefusedError, type UnansweredError } from "./errors";
import { request } from "./request";
import type { OutcomeState } from "./types";

/** asking: not known yet whether it was executed; carriedOut: executed, as the server reports. */
type CommandStatus = "asking" | "carriedOut" | null;
export const commandStatus = signal<CommandStatus>(null);

const PAUSE_MS = 500;
const LONGEST_ASKED_MS = 60_000;
const SHOWN_MS = 8000;

const wait = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));

let asking = 0;

function setStatus(next: CommandStatus): void {
  commandStatus.value = next;
  if (next === "carriedOut") {
    setTimeout(() => {
      if (commandStatus.peek() === next) commandStatus.value = null;
    }, SHOWN_MS);
  }
}

/**
 * Resolves where it was carried out. Throws `NotCarriedOutError` where it was not, and
 * the `UnansweredError` itself where the server cannot say even after a minute.
 */
export async function learnOutcome(unanswered: UnansweredError): Promise<void> {
  asking++;
  setStatus("asking");
  try {
    const status = await askUntilKnown(unanswered);
    if (unanswered.call !== null) answerCall(unanswered.call, status);
    if (status === null || status >= 400) throw new NotCarriedOutError(status);
    setStatus("carriedOut");
  } finally {
    asking--;
    if (asking === 0 && commandStatus.peek() === "asking") setStatus(null);
  }
}

/** The status that it was answered with; null where it never came to the server. */
async function askUntilKnown(unanswered: UnansweredError): Promise<number | null> {
  const endMs = performance.now() + LONGEST_ASKED_MS;
  let strange = 0;
  while (performance.now() < endMs) {
    const found = await ask(`requests/${unanswered.request}`);
    if (found?.outcome === "carried_out" || found?.outcome === "refused") return found.status;
    const sinceS = (performance.now() - unanswered.sentMs) / 1000;
    if (found?.outcome === "unknown" && found.known_for_s < sinceS) break;
    // Asked twice: it may have come after the first question, by another way.
    strange = found?.outcome === "unknown" ? strange + 1 : 0;
    if (strange === 2) return null;
    await wait(PAUSE_MS);
  }
  throw unanswered;
}

async function ask(path: string): Promise<OutcomeState | null> {
  try {
    return (await request("get", path)) as OutcomeState;
  } catch (error) {
    if (error instanceof RefusedError) throw error;
    return null;
  }
}
