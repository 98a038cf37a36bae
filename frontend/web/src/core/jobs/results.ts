/**
 * List of results that jobs of one kind extend: read when shown, and again when a job has ended.
 */
import { type Signal, signal } from "@preact/signals";
import type { Job } from "../api/jobs";
import { showErrorIn, userAttempt } from "../state/actions";
import { followJobs } from "./follow";
import { createReader } from "./poll";

interface Results<T> {
  /** null until the server has answered. */
  result: Signal<T | null>;
  /** Reason why the last request was rejected. */
  problem: Signal<string>;
  job: Signal<Job | null>;
  attempt: ReturnType<typeof userAttempt>;
  read: () => Promise<void>;
  /** Read the list, and follow the running job. */
  open: () => Promise<void>;
  /** Follow a job that was started on this page. */
  follow: (startedJob: Job) => Promise<void>;
  unfollow: () => void;
  cancel: () => Promise<void>;
}

export function followResults<T>(kind: Job["kind"], query: () => Promise<T>): Results<T> {
  const result = signal<T | null>(null);
  const problem = signal("");
  const attempt = userAttempt(problem);
  const readResult = createReader(showErrorIn(problem));
  const read = async () => {
    problem.value = "";
    await readResult(query, (answer) => {
      result.value = answer;
    });
  };
  const { job, follow, resume, unfollow, cancel } = followJobs(
    kind,
    showErrorIn(problem),
    () => void read(),
  );
  return {
    result,
    problem,
    job,
    attempt,
    read,
    open: async () => {
      await read();
      await attempt(resume);
    },
    follow,
    unfollow,
    cancel: async () => {
      await attempt(cancel);
    },
  };
}
