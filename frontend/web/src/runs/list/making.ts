/** A file that the server works on for long before it can be saved: that it does, and what came of it. */
import { signal } from "@preact/signals";
import { fetchFile } from "../../core/api/runs";
import { attempt, runsProblem } from "./problem";

export interface Making {
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
