/** One job of the server, followed until it ends. */
import { type Signal, signal } from "@preact/signals";
import { type Job, listJobs, readJob, stopJob } from "../api/jobs";
import { isGoing } from "./progress";

const PAUSE_MS = 700;
const pause = () => new Promise((resolve) => setTimeout(resolve, PAUSE_MS));

export interface Followed {
  job: Signal<Job | null>;
  /** Follows it; resolves once it has ended, or another is followed, or none. Rejects unanswered. */
  follow: (job: Job) => Promise<void>;
  /** Takes up the one of this kind that is under way, from before the page was loaded. */
  resume: () => Promise<void>;
  leave: () => void;
  cancel: () => Promise<void>;
}

/** onEnd: once a job has ended. */
export function followJobs(kind: Job["kind"], onEnd: () => void): Followed {
  const job = signal<Job | null>(null);
  let round = 0;
  const follow = async (begun: Job): Promise<void> => {
    const number = ++round;
    job.value = begun;
    while (isGoing(job.peek())) {
      await pause();
      if (number !== round) return;
      const found = await readJob(begun.id);
      if (number !== round) return;
      job.value = found;
    }
    onEnd();
  };
  return {
    job,
    follow,
    resume: async () => {
      const going = (await listJobs()).find((one) => one.kind === kind && isGoing(one));
      if (going !== undefined) await follow(going);
    },
    leave: () => {
      round++;
    },
    cancel: async () => {
      const now = job.peek();
      if (now !== null && isGoing(now)) job.value = await stopJob(now.id);
    },
  };
}
