/** Long-running job: progress, speed and remaining time. */
import type { ComponentChildren } from "preact";
import type { Job } from "../api/jobs";
import { text } from "../text/en";
import { formatSeconds } from "../units";

const words = text.jobs;

export const isJobRunning = (job: Pick<Job, "status"> | null): boolean =>
  job?.status === "waiting" || job?.status === "running";

/** Status in a few words; empty for a completed job. */
export function describeJob(job: Job | null): string[] {
  if (job === null) return [];
  const parts = isJobRunning(job) || job.status !== "done" ? [words.status[job.status]] : [];
  if (job.problem) parts.push(job.problem);
  if (job.status !== "running") return parts;
  parts.push(job.rate_per_s === null ? words.compiling : words.rate(job.rate_per_s));
  if (job.left_s !== null) parts.push(words.left(formatSeconds(job.left_s)));
  return parts;
}

interface JobProgressProps {
  job: Job | null;
  /** Progress in words. */
  done: string;
  total: number;
  /** Label of the bar for screen readers. */
  label: string;
  onCancel: () => void;
  /** Commands that are available while the job is not running. */
  children?: ComponentChildren;
}

export function JobProgress({ job, done, total, label, onCancel, children }: JobProgressProps) {
  const hasStarted = isJobRunning(job);
  return (
    <div class="row grow">
      <span role="status" class="as-written">
        {[done, ...describeJob(job)].join(" · ")}
      </span>
      {hasStarted && <progress value={job?.done ?? 0} max={total} aria-label={label} />}
      {hasStarted ? (
        <button type="button" class="button" title={words.cancelHint} onClick={onCancel}>
          {words.cancel}
        </button>
      ) : (
        children
      )}
    </div>
  );
}
