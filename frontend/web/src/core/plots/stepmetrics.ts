/** How well a lane did after an event, in the numbers that the table beside the plots has too. */
import type { SessionEvent, SessionState } from "../api/types";
import { type Cast, controllerAt } from "../state/lanes";
import type { SampleRing } from "../stream/ring";
import { measureStep, type StepMetrics } from "./statistics";

const ERROR = "position_error_rad";

interface Step {
  /** Its end, session time in s; infinity where it goes on. */
  untilS: number;
  /** Of the lane of an index among those shown; null where nothing is known of it. */
  read: (lane: number) => StepMetrics | null;
}

/** The window that an event began: when it ends, and its metrics of the present lanes. */
function findWindow(state: SessionState, tick: number) {
  if (state.window.start_tick === tick) {
    return { endS: null, lanes: state.lanes.map((lane) => lane.in_window) };
  }
  const ended = state.ended_windows.find((window) => window.start_tick === tick);
  return ended && { endS: ended.end_s, lanes: ended.lanes };
}

/**
 * What an event began: the session's window, measured on every sample by the server. An event that
 * began none, as a load that ends by itself, is measured up to the next event on the samples held.
 *
 * shown: who controlled the lanes that the plots show, of which `ring` holds the samples; present:
 * those of the session. nextS: when the next event comes, s.
 */
export function findStep(
  state: SessionState,
  event: SessionEvent,
  nextS: number,
  { ring, shown, present }: { ring: SampleRing; shown: Cast; present: Cast },
): Step {
  const window = findWindow(state, event.tick);
  if (window === undefined) {
    const read = (lane: number) => measureStep(ring, ERROR, lane + 1, event.time_s, nextS);
    return { untilS: nextS, read };
  }
  const numberAt = (cast: Cast, lane: number) =>
    controllerAt(cast[lane] ?? [], event.time_s)?.number;
  const read = (lane: number) => {
    const number = numberAt(shown, lane);
    const place = present.findIndex((_, other) => numberAt(present, other) === number);
    const metrics = number === undefined ? null : window.lanes[place];
    return metrics
      ? {
          peak: metrics.peak_position_error_rad,
          rms: metrics.rms_position_error_rad,
          recoveryS: metrics.recovery_time_s,
          missingS: 0,
        }
      : null;
  };
  return { untilS: window.endS ?? Number.POSITIVE_INFINITY, read };
}
