/** A run as text. */

import type { RunDetails } from "../../core/api/types";
import { describeLaw } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { formatFixed } from "../../core/units";
import type { Filter } from "./list";

const DAY = new Intl.DateTimeFormat("en-GB", {
  day: "numeric",
  month: "short",
  year: "numeric",
  hour: "2-digit",
  minute: "2-digit",
});

/** A moment in UTC as local date and time. */
export function formatMoment(iso: string): string {
  const moment = new Date(iso);
  return Number.isNaN(moment.getTime()) ? iso : DAY.format(moment);
}

const SHORT = new Intl.DateTimeFormat("en-GB", {
  day: "numeric",
  month: "short",
  hour: "2-digit",
  minute: "2-digit",
});
const SHORT_FOR_MS = 300 * 86_400_000;

/** As `formatMoment`, with the year only if it is not the current one. */
export function formatMomentShort(iso: string): string {
  const isRecent = Date.now() - new Date(iso).getTime() < SHORT_FOR_MS;
  return isRecent ? SHORT.format(new Date(iso)) : formatMoment(iso);
}

export function formatDuration(seconds: number): string {
  const rounded = Number(seconds.toFixed(1));
  if (rounded < 60) return t("runs.seconds", { seconds: rounded });
  const wholeSeconds = Math.round(seconds);
  return t("runs.minutes", { minutes: Math.floor(wholeSeconds / 60), seconds: wholeSeconds % 60 });
}

/** Length of a record, and its start in session time, which its files and scripts use. */
export function formatLength(
  run: Pick<RunDetails, "duration_s" | "first_tick" | "period_s">,
): string {
  const length = formatDuration(run.duration_s);
  return run.first_tick === 0
    ? length
    : t("run.lengthFrom", { length, start: formatFixed(run.first_tick * run.period_s, 2) });
}

/** Text of a value by which runs are filtered. */
export function nameValue(filter: Filter, value: string): string {
  switch (filter) {
    case "law":
      return describeLaw(value);
    case "figure":
      return t("runs.figureName", { figure: value.toUpperCase() });
    case "tag":
      return value;
    default:
      return t(`runs.values.${filter}.${value}` as "runs.values.load.none", {
        defaultValue: value,
      });
  }
}
