/** Follows one job of the server until it ends. */
import { type Signal, signal } from "@preact/signals";
import { type Job, listJobs, readJob, stopJob } from "../api/jobs";
import { createPoll } from "./poll";
import { isJobRunning } from "./progress";

interface JobFollower {
  /** null while no job is followed, and if the server no longer has it. */
  job: Signal<Job | null>;
  /** Follow a job; resolves once it has ended or is gone, or another or no job is followed. */
  follow: (job: Job) => Promise<void>;
  /** Follow the running job of this kind, started before the page was loaded. */
  resume: () => Promise<void>;
  unfollow: () => void;
  cancel: () => Promise<void>;
}

/** onError: as in `createPoll`. onEnd: called once a job has ended. */
export function followJobs(
  kind: Job["kind"],
  onError: (error: unknown) => void,
  onEnd: () => void,
): JobFollower {
  const job = signal<Job | null>(null);
  const poll = createPoll(onError);
  const follow = async (startedJob: Job): Promise<void> => {
    job.value = startedJob;
    const pollEnd = await poll.follow(
      () => readJob(startedJob.id),
      (update) => {
        job.value = update;
        return !isJobRunning(update);
      },
    );
    if (pollEnd === "ended") onEnd();
    else if (pollEnd === "refused") job.value = null;
  };
  return {
    job,
    follow,
    resume: async () => {
      const runningJob = (await listJobs()).find(
        (candidate) => candidate.kind === kind && isJobRunning(candidate),
      );
      if (runningJob !== undefined) await follow(runningJob);
    },
    unfollow: poll.stop,
    cancel: async () => {
      const current = job.peek();
      if (current !== null && isJobRunning(current)) job.value = await stopJob(current.id);
    },
  };
}
