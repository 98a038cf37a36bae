/** One job of the server, followed until it ends. */
import { type Signal, signal } from "@preact/signals";
import { type Job, listJobs, readJob, stopJob } from "../api/jobs";
import { polling } from "./poll";
import { isGoing } from "./progress";

interface Followed {
  /** null while none is looked at, and where the server does not know it any more. */
  job: Signal<Job | null>;
  /** Follows it; resolves once it has ended or is gone, or another is followed, or none. */
  follow: (job: Job) => Promise<void>;
  /** Takes up the one of this kind that is under way, from before the page was loaded. */
  resume: () => Promise<void>;
  leave: () => void;
  cancel: () => Promise<void>;
}

/** tell: as that of `polling`. onEnd: once a job has ended. */
export function followJobs(
  kind: Job["kind"],
  onError: (error: unknown) => void,
  onEnd: () => void,
): Followed {
  const job = signal<Job | null>(null);
  const poll = polling(onError);
  const follow = async (begun: Job): Promise<void> => {
    job.value = begun;
    const ending = await poll.follow(
      () => readJob(begun.id),
      (found) => {
        job.value = found;
        return !isGoing(found);
      },
    );
    if (ending === "ended") onEnd();
    else if (ending === "refused") job.value = null;
  };
  return {
    job,
    follow,
    resume: async () => {
      const going = (await listJobs()).find((one) => one.kind === kind && isGoing(one));
      if (going !== undefined) await follow(going);
    },
    leave: poll.leave,
    cancel: async () => {
      const now = job.peek();
      if (now !== null && isGoing(now)) job.value = await stopJob(now.id);
    },
  };
}
