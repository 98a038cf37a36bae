/** What a call about runs came to: done, or why not, in words. */
import { signal } from "@preact/signals";
import { LockedError } from "../api/errors";
import { explain } from "../state/actions";
import { phase } from "../state/session";

/** The last refusal; the next call takes its place. */
export const runsProblem = signal("");

/** The answer, or null where the call was refused; then the page says why. */
export async function attempt<T>(request: () => Promise<T>): Promise<T | null> {
  runsProblem.value = "";
  try {
    return await request();
  } catch (error) {
    if (error instanceof LockedError) phase.value = "locked";
    runsProblem.value = explain(error);
    return null;
  }
}
