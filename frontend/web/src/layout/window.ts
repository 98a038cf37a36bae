/** The window of the metrics in words, the recovery time in it, and the best lane. */
import type { LaneRow, Metrics, SessionState, WindowState } from "../core/api/types";
import { isLost } from "../core/plots/metricrows";
import type { SampleRing } from "../core/stream/ring";
import { t } from "../core/text/t";

import { formatFixed, formatNumber } from "../core/units";
import { bestOf } from "../core/widgets/tables";
import { isDisturbed } from "../runs/list/measured";

/** A label within a sentence; NDOBC keeps its capitals. */
const inSentence = (label: string): string =>
  label.replace(/^[A-Z](?=[a-z])/, (letter) => letter.toLowerCase());

const windowText = ({ label, start_s: startS }: WindowState): string =>
  t("windows.at", { label: inSentence(label), time: formatFixed(startS, 2) });

/** Start of the window and its time, in the words of a record. */
export const sinceOf = ({ kind, label, start_s: startS }: WindowState): string =>
  kind === "start"
    ? t("measured.start")
    : t("measured.since", { what: label, from: formatFixed(startS, 2) });

const STEADY_STATE_S = 0.5;

/** Whether a lane has ended: without samples for half a second. */
export const hasEnded = (
  lane: Pick<LaneRow, "in_window">,
  { time_s: now, window }: Pick<SessionState, "time_s" | "window">,
): boolean => lane.in_window === null && now - window.start_s > STEADY_STATE_S;

const HALF_TICK_S = 0.0005;

/**
 * The newest position error of a lane, rad; NaN before the first sample of its controller, since
 * a change while paused leaves the sample of the previous one.
 */
export function readCurrentError(ring: SampleRing, lane: number, controllerStartS: number): number {
  if (ring.newestTime < controllerStartS - HALF_TICK_S) return Number.NaN;
  return ring.newest("position_error_rad", lane);
}

/** The rows of the lanes of each joint; all rows for a single joint. */
const groupOfJoints = (lanes: SessionState["lanes"]): number[][] =>
  [...new Set(lanes.map(({ joint }) => joint))].map((joint) =>
    [...lanes.keys()].filter((row) => lanes[row]?.joint === joint),
  );

/** Whether the controllers of all lanes started before the window, or all with it. */
const areInStep = ({ lanes, window }: Pick<SessionState, "lanes" | "window">): boolean =>
  new Set(lanes.map(({ segments }) => segments.at(-1)?.start_tick === window.start_tick)).size <= 1;

/** Whether the window started with a controller that another lane had until then. */
const haveExchanged = ({ lanes, window }: Pick<SessionState, "lanes" | "window">): boolean => {
  const present = new Set(lanes.map(({ segments }) => segments.at(-1)?.number));
  return lanes.some(({ segments }) => {
    const [now, before] = [segments.at(-1), segments.at(-2)];
    return now?.start_tick === window.start_tick && before && present.has(before.number);
  });
};

/**
 * The lanes with the clearly smallest value, one for each joint of an arm. None on a bench, whose
 * lanes have different plants, none if one controller alone started with the window, because the
 * others responded to an earlier load, and none if controllers exchanged their lanes, because they
 * started from different states.
 */
export const bestIn = (
  state: Pick<SessionState, "bench" | "lanes" | "window">,
  values: Parameters<typeof bestOf>[0],
): readonly number[] => {
  if (state.bench !== null || !areInStep(state) || haveExchanged(state)) return [];
  return groupOfJoints(state.lanes).flatMap((rows) => {
    const best = rows[bestOf(rows.map((row) => values[row]))];
    return best === undefined || rows.length < 2 ? [] : [best];
  });
};

/** The recovery time, or the reason why there is none. */
export interface Recovery {
  seconds: number | null;
  words: string;
  hint: string;
}

/**
 * Name and hint of the recovery time: on a bench it starts with the operator's mark, before the
 * load acts.
 */
export const recoveryNameOf = ({ bench }: Pick<SessionState, "bench">) =>
  bench === null
    ? { name: t("measured.names.recovered"), hint: t("windows.recovery") }
    : { name: t("windows.marked.name"), hint: t("windows.marked.hint") };

/** metrics: of the window; null for a lane without values in it. */
export function recoveryOf(metrics: Metrics | null, window: WindowState): Recovery {
  const none = formatNumber(null);
  if (!isDisturbed(window)) {
    const words = window.kind === "start" ? t("windows.noLoad") : none;
    return { seconds: null, words, hint: t("windows.undisturbed") };
  }
  const hint = t("windows.recoveryFrom", { load: windowText(window) });
  if (metrics === null) return { seconds: null, words: none, hint };
  const { recovery_time_s: seconds } = metrics;
  if (
    seconds !== null &&
    isLost(metrics.steady_state_position_error_rad, metrics.peak_position_error_rad)
  ) {
    const after = formatNumber(seconds, 3, 2);
    return {
      seconds: null,
      words: t("windows.lost"),
      hint: t("windows.lostAfter", { seconds: after, load: windowText(window) }),
    };
  }
  if (seconds !== null) return { seconds, words: formatNumber(seconds, 3, 2), hint };
  return { seconds, words: t("windows.notYet"), hint };
}
