/**
 * List of results that jobs of one kind extend: read when shown, and again when a job has ended.
 */
import { signal } from "@preact/signals";
import type { Job } from "../api/jobs";
import { followJobs } from "./follow";
import { createWork } from "./work";

export function followResults<T>(kind: Job["kind"], query: () => Promise<T>) {
  /** null until the server has answered. */
  const result = signal<T | null>(null);
  const { problem, isBusy, perform, attempt, showError, read: readAnswer } = createWork();
  const read = async () => {
    problem.value = "";
    await readAnswer(query, (answer) => {
      result.value = answer;
    });
  };
  const { resume, cancel, ...jobs } = followJobs(kind, showError, () => void read());
  return {
    ...jobs,
    result,
    problem,
    isBusy,
    read,
    /** Read the list, and follow the running job. */
    open: async () => {
      await read();
      await attempt(resume);
    },
    perform,
    cancel: async () => {
      await perform("cancel", cancel);
    },
  };
}
