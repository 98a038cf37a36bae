/** What a call about runs came to: done, or why not, in words. */
import { signal } from "@preact/signals";
import { LockedError, UnansweredError } from "../../core/api/errors";
import { learnOutcome } from "../../core/api/outcome";
import { fetchFile } from "../../core/api/runs";
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

/** Of a lost answer outcome of the request, as the server says; else why it was refused. */
async function describeOutcome(error: unknown): Promise<string> {
  if (!(error instanceof UnansweredError) || error.request === null) return explain(error);
  try {
    await learnOutcome(error);
    return text.connection.doneUnseen;
  } catch (outcome) {
    return explain(outcome);
  }
}

// A file that the server works on for long before it can be saved: its progress, and the result.

interface Making {
  run: string;
  stage: "making" | "saved" | "failed";
  /** Why it failed. */
  message: string;
}

/** So long a browser may take to begin with the file. */
const KEPT_MS = 60_000;

export const making = signal<Making | null>(null);

/** Fetches the file, and gives it to the browser to save; one at a time. */
export async function makeFile(run: string, path: string): Promise<void> {
  if (making.peek()?.stage === "making") return;
  making.value = { run, stage: "making", message: "" };
  const file = await attempt(() => fetchFile(path));
  if (file === null) {
    making.value = { run, stage: "failed", message: runsProblem.peek() };
    runsProblem.value = "";
    return;
  }
  const link = document.createElement("a");
  link.href = URL.createObjectURL(file.content);
  link.download = file.name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), KEPT_MS);
  making.value = { run, stage: "saved", message: "" };
}
