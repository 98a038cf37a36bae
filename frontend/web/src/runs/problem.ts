/** What a call about runs came to: done, or why not, in words. */
import { signal } from "@preact/signals";
import { LockedError, RefusedError } from "../api/errors";
import { phase } from "../state/session";
import { text } from "../text/en";

/** The last refusal; the next call takes its place. */
export const runsProblem = signal("");

export function explain(error: unknown): string {
  if (error instanceof LockedError) phase.value = "locked";
  return error instanceof RefusedError ? error.message : text.connection.unreachable;
}

/** The answer, or null where the call was refused; then the page says why. */
export async function attempt<T>(request: () => Promise<T>): Promise<T | null> {
  runsProblem.value = "";
  try {
    return await request();
  } catch (error) {
    runsProblem.value = explain(error);
    return null;
  }
}
