/** What jobs of one kind add to: read where it is looked at, and again when one of them has ended. */
import { type Signal, signal } from "@preact/signals";
import type { Job } from "../api/jobs";
import { attempting, showErrorIn } from "../state/actions";
import { followJobs } from "./follow";
import { reading } from "./poll";

interface Results<T> {
  /** null until the server has answered. */
  found: Signal<T | null>;
  /** Why the last wish was refused. */
  problem: Signal<string>;
  job: Signal<Job | null>;
  attempt: ReturnType<typeof attempting>;
  read: () => Promise<void>;
  /** Reads it, and takes up the job that is under way. */
  open: () => Promise<void>;
  /** Follows a job that was begun here. */
  follow: (begun: Job) => Promise<void>;
  leave: () => void;
  cancel: () => Promise<void>;
}

export function followResults<T>(kind: Job["kind"], ask: () => Promise<T>): Results<T> {
  const found = signal<T | null>(null);
  const problem = signal("");
  const attempt = attempting(problem);
  const readFound = reading(showErrorIn(problem));
  const read = async () => {
    problem.value = "";
    await readFound(ask, (answer) => {
      found.value = answer;
    });
  };
  const { job, follow, resume, leave, cancel } = followJobs(
    kind,
    showErrorIn(problem),
    () => void read(),
  );
  return {
    found,
    problem,
    job,
    attempt,
    read,
    open: async () => {
      await read();
      await attempt(resume);
    },
    follow,
    leave,
    cancel: async () => {
      await attempt(cancel);
    },
  };
}
