/** What a call about runs came to: done, or why not, in words. */
import { signal } from "@preact/signals";
import { LockedError, UnansweredError } from "../../core/api/errors";
import { learnOutcome } from "../../core/api/outcome";
import { explain } from "../../core/state/actions";
import { phase } from "../../core/state/session";
import { text } from "../../core/text/en";

/** The last refusal; the next call takes its place. */
export const runsProblem = signal("");

/** The answer, or null where the call was refused; then the page says why. */
export async function attempt<T>(request: () => Promise<T>): Promise<T | null> {
  runsProblem.value = "";
  try {
    return await request();
  } catch (error) {
    if (error instanceof LockedError) phase.value = "locked";
    runsProblem.value = await describeOutcome(error);
    return null;
  }
}

/** Of a lost answer what became of the request, as the server says; else why it was refused. */
async function describeOutcome(error: unknown): Promise<string> {
  if (!(error instanceof UnansweredError) || error.request === null) return explain(error);
  try {
    await learnOutcome(error);
    return text.connection.doneUnseen;
  } catch (outcome) {
    return explain(outcome);
  }
}
