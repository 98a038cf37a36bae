/** A run in words. */
import type { RunSummary } from "../api/types";
import { text } from "../text/en";

export const nameOf = (run: Pick<RunSummary, "id" | "name">): string => run.name || run.id;

const DAY = new Intl.DateTimeFormat("en-GB", {
  day: "numeric",
  month: "short",
  year: "numeric",
  hour: "2-digit",
  minute: "2-digit",
});

/** The reader's own day and time of a moment in UTC. */
export function formatMoment(iso: string): string {
  const moment = new Date(iso);
  return Number.isNaN(moment.getTime()) ? iso : DAY.format(moment);
}

export function formatDuration(seconds: number): string {
  const rounded = Number(seconds.toFixed(1));
  if (rounded < 60) return text.runs.seconds(rounded);
  const whole = Math.round(seconds);
  return text.runs.minutes(Math.floor(whole / 60), whole % 60);
}
