/** Text for the window of a run in which its metrics were measured. */

import type { MeasuredWindow, RunSummary } from "../../core/api/types";
import { t } from "../../core/text/t";
import { formatFixed } from "../../core/units";

export type Measured = Pick<
  MeasuredWindow,
  "label" | "start_s" | "end_s" | "is_whole" | "lanes" | "load_ended"
>;

/** In the time of the replay, which starts with the first sample. */
export function shiftToRecordTime<T extends Measured>(
  window: T,
  { first_tick: first, period_s: period }: Pick<RunSummary, "first_tick" | "period_s">,
): T {
  const zero = first * period;
  return { ...window, start_s: window.start_s - zero, end_s: window.end_s - zero };
}

/** isNamed: with the controller, if others controlled other windows of the run. */
export function describeMeasured(window: Measured, isNamed = false): string {
  const { label, start_s: start, end_s: end, is_whole: isWhole, lanes } = window;
  const what = isWhole
    ? t("measured.whole")
    : t("measured.during", {
        what: label || t("measured.start"),
        from: formatFixed(start, 2),
        to: formatFixed(end, 2),
      });
  return isNamed ? t("measured.controlled", { lanes: lanes.join(" / "), what }) : what;
}

/** The steady-state error, or the reason why there is none. */
export function explainSteadyState({ load_ended: hasEnded, start_s: start, end_s: end }: Measured) {
  if (hasEnded) return t("measured.loadEnded");
  return end - start < 1 ? t("measured.tooShort") : t("measured.steadyStateHint");
}

/** Whether a load was added or removed at the start of the window. */
export const isDisturbed = ({ kind }: Pick<MeasuredWindow, "kind">): boolean =>
  kind === "load" || kind === "unload";
