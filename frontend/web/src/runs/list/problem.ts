/** Result of a request about runs: done, or the reason of a rejection, as text. */
import { signal } from "@preact/signals";
import { LockedError, UnansweredError } from "../../core/api/errors";
import { awaitOutcome } from "../../core/api/outcome";
import { fetchFile } from "../../core/api/runs";
import { explain } from "../../core/state/actions";
import { phase } from "../../core/state/session";
import { t } from "../../core/text/t";

/** The last rejection; cleared by the next request. */
export const runsProblem = signal("");

/** The answer, or null if the request was rejected; then the page shows the reason. */
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

/** For a lost answer the outcome that the server reports; otherwise the reason of the rejection. */
async function describeOutcome(error: unknown): Promise<string> {
  if (!(error instanceof UnansweredError) || error.request === null) return explain(error);
  try {
    await awaitOutcome(error);
    return t("connection.doneUnseen");
  } catch (outcome) {
    return explain(outcome);
  }
}

// A file that the server prepares for a long time: its progress, and the result.

interface FileExport {
  run: string;
  stage: "making" | "saved" | "failed";
  /** Reason of the failure. */
  message: string;
}

/** Maximum time until a browser starts to save the file. */
const URL_LIFETIME_MS = 60_000;

export const fileExport = signal<FileExport | null>(null);

/** Download the file and save it in the browser; one at a time. */
export async function exportFile(run: string, path: string): Promise<void> {
  if (fileExport.peek()?.stage === "making") return;
  fileExport.value = { run, stage: "making", message: "" };
  const file = await attempt(() => fetchFile(path));
  if (file === null) {
    fileExport.value = { run, stage: "failed", message: runsProblem.peek() };
    runsProblem.value = "";
    return;
  }
  const link = document.createElement("a");
  link.href = URL.createObjectURL(file.content);
  link.download = file.name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), URL_LIFETIME_MS);
  fileExport.value = { run, stage: "saved", message: "" };
}
