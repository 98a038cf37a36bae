/** Every wish of the user goes through `perform`: it sends, takes over the answer, keeps the refusal. */
import { signal } from "@preact/signals";
import { LockedError, NotCarriedOutError, RefusedError, UnansweredError } from "../api/errors";
import type { SessionState } from "../api/types";
import { text } from "../text/en";
import { explainRefusal } from "./refusal";
import { acceptState, phase } from "./session";

/** The last refusal and the control that caused it; the next action takes its place. */
export const problem = signal<{ control: string; message: string } | null>(null);

/** Why a wish was not fulfilled, as the user reads it. */
export function explain(error: unknown): string {
  if (error instanceof RefusedError) return explainRefusal(error);
  if (error instanceof NotCarriedOutError) {
    return error.status === null
      ? text.connection.notCarriedOut
      : text.connection.refused(error.status);
  }
  const isUnknown = error instanceof UnansweredError && error.request !== null;
  return isUnknown ? text.connection.stillUnknown : text.connection.unreachable;
}

/** Sends a request for a control; resolves when the page shows what the server holds. */
export async function perform(
  control: string,
  request: () => Promise<SessionState>,
): Promise<boolean> {
  problem.value = null;
  try {
    acceptState(await request());
    return true;
  } catch (error) {
    if (error instanceof LockedError) phase.value = "locked";
    problem.value = { control, message: explain(error) };
    return false;
  }
}
