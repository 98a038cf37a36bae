/** Long-running job: progress, speed and remaining time. */
import type { ComponentChildren } from "preact";
import type { Job } from "../api/jobs";
import { t } from "../text/t";
import { formatCount, formatFixed, formatSeconds } from "../units";

export const isJobRunning = (job: Pick<Job, "status"> | null): boolean =>
  job?.status === "waiting" || job?.status === "running";

/** Status in a few words; empty for a completed job. */
export function describeJob(job: Job | null): string[] {
  if (job === null) return [];
  const parts: string[] =
    isJobRunning(job) || job.status !== "done" ? [t(`jobs.status.${job.status}`)] : [];
  if (job.problem) parts.push(job.problem);
  if (job.status !== "running") return parts;
  parts.push(
    job.rate_per_s === null
      ? t("jobs.compiling")
      : t("jobs.rate", {
          rate: job.rate_per_s < 10 ? formatFixed(job.rate_per_s, 1) : formatCount(job.rate_per_s),
        }),
  );
  if (job.left_s !== null) parts.push(t("jobs.left", { time: formatSeconds(job.left_s) }));
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
        <button type="button" class="button" title={t("jobs.cancelHint")} onClick={onCancel}>
          {t("jobs.cancel")}
        </button>
      ) : (
        children
      )}
    </div>
  );
}
