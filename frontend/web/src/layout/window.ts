/** The window of the numbers in words, the recovery time in it, and which lane does best in it. */
import type { LaneRow, Metrics, SessionState, WindowState } from "../core/api/types";
import { isLost } from "../core/plots/metricrows";
import { text } from "../core/text/en";
import { measuredText } from "../core/text/measured";
import { formatNumber } from "../core/units";
import { bestOf } from "../core/widgets/tables";
import { isDisturbed } from "../runs/list/measured";

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

/** Whether the controllers of all lanes began before the window, or all began with it. */
const areComparable = ({ lanes, window }: Pick<SessionState, "lanes" | "window">): boolean =>
  new Set(lanes.map(({ segments }) => segments.at(-1)?.start_tick === window.start_tick)).size <= 1;

/**
 * The lane whose number is clearly the smallest. None on a bench, whose lanes are not of one plant,
 * and none where one controller alone began with the window: others had responded to the load before.
 */
export const bestIn = (
  state: Pick<SessionState, "bench" | "lanes" | "window">,
  values: Parameters<typeof bestOf>[0],
): number => (state.bench === null && areComparable(state) ? bestOf(values) : -1);

/** The recovery time, or in words why there is none. */
export interface Recovery {
  seconds: number | null;
  words: string;
  hint: string;
}

/** Name and hint of the recovery time: on a bench it begins with the mark, before the load acts. */
export const recoveryNameOf = ({ bench }: Pick<SessionState, "bench">) =>
  bench === null ? { name: measuredText.names.recovered, hint: windows.recovery } : windows.marked;

/** metrics: of the window; null for a lane that has no numbers in it. */
export function recoveryOf(metrics: Metrics | null, window: WindowState): Recovery {
  const none = formatNumber(null);
  if (!isDisturbed(window)) {
    const words = window.kind === "start" ? windows.noLoad : none;
    return { seconds: null, words, hint: windows.undisturbed };
  }
  const hint = windows.recoveryFrom(at(window));
  if (metrics === null) return { seconds: null, words: none, hint };
  const { recovery_time_s: seconds } = metrics;
  if (
    seconds !== null &&
    isLost(metrics.steady_state_position_error_rad, metrics.peak_position_error_rad)
  ) {
    const after = formatNumber(seconds, 3, 2);
    return { seconds: null, words: windows.lost, hint: windows.lostAfter(at(window), after) };
  }
  if (seconds !== null) return { seconds, words: formatNumber(seconds, 3, 2), hint };
  return { seconds, words: windows.notYet, hint };
}
