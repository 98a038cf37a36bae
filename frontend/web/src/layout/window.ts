/** Since when numbers are measured, in words, and what became of the load. */
import type { LaneRow, Metrics, SessionState, WindowState } from "../core/api/types";
import { isLost } from "../core/plots/metricrows";
import { text } from "../core/text/en";
import { measuredText } from "../core/text/measured";
import { formatNumber } from "../core/units";
import { bestOf } from "../core/widgets/tables";

const { windows } = text;

/** A label within a sentence; NDOBC stays as it is. */
const within = (label: string): string =>
  label.replace(/^[A-Z](?=[a-z])/, (letter) => letter.toLowerCase());

const at = ({ label, start_s: startS }: WindowState): string =>
  windows.at(within(label), startS.toFixed(2));

/** What began the window, and when; in the words in which a record tells of it. */
export const sinceOf = ({ kind, label, start_s: startS }: WindowState): string =>
  kind === "start" ? measuredText.start : measuredText.since(label, startS.toFixed(2));

const STEADY_STATE_S = 0.5;

/** Whether a lane is simulated no further: it has had no numbers for half a second. */
export const hasEnded = (
  lane: Pick<LaneRow, "in_window">,
  { time_s: now, window }: Pick<SessionState, "time_s" | "window">,
): boolean => lane.in_window === null && now - window.start_s > STEADY_STATE_S;

/** Whose number is clearly the smallest; none beside a bench, whose lanes are not of one plant. */
export const bestIn = (
  { bench }: Pick<SessionState, "bench">,
  values: Parameters<typeof bestOf>[0],
): number => (bench === null ? bestOf(values) : -1);

/** How soon the error was small again after the load; what is no time is said in words. */
export interface Recovery {
  seconds: number | null;
  words: string;
  hint: string;
}

/** metrics: of the load's window; null for a lane that was not there when the load came. */
export function recoveryOf(metrics: Metrics | null, load: WindowState | null): Recovery {
  if (load === null) return { seconds: null, words: windows.noLoad, hint: windows.recovery };
  const hint = windows.recoveryFrom(at(load));
  if (metrics === null) return { seconds: null, words: formatNumber(null), hint: windows.notThere };
  const { recovery_time_s: seconds } = metrics;
  if (
    seconds !== null &&
    isLost(metrics.steady_state_position_error_rad, metrics.peak_position_error_rad)
  ) {
    const after = formatNumber(seconds, 3, 2);
    return { seconds: null, words: windows.lost, hint: windows.lostAfter(at(load), after) };
  }
  if (seconds !== null) return { seconds, words: formatNumber(seconds, 3, 2), hint };
  if (load.end_s === null) return { seconds, words: windows.notYet, hint };
  const end = load.end_s.toFixed(2);
  return { seconds, words: windows.notBefore(end), hint: windows.endedBefore(at(load), end) };
}
