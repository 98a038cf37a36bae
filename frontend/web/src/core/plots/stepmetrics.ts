/** Metrics of a lane after an event, as in the table next to the plots. */
import type { SessionEvent, SessionState } from "../api/types";
import { type Cast, controllerAt } from "../state/lanes";
import type { SampleRing } from "../stream/ring";
import { measureBetween } from "./statistics";

const ERROR = "position_error_rad";
const LATE_S = 0.1;

interface StepMetrics {
  peak: number;
  rms: number;
  /** From the step until the error stays small, s; null: not yet, NaN: not measured. */
  recoveryS: number | null;
  /** For so long of it there is no number, s: the true peak may be higher. */
  missingS: number;
}

interface Step {
  /** Its end, session time in s; infinity where it goes on. */
  untilS: number;
  /** Of the lane of an index among those shown; null where nothing is known of it. */
  read: (lane: number) => StepMetrics | null;
}

/** The error from a time on up to before another; null where its beginning is held no more. */
function measureHeld(ring: SampleRing, lane: number, fromS: number, toS: number) {
  const first = ring.firstAt(fromS);
  const last = Math.min(ring.length, ring.firstAt(toS)) - 1;
  if (first > last || (first === 0 && ring.oldestTime > fromS + LATE_S)) return null;
  const { min, max, rms, missingS } = measureBetween(ring, ERROR, lane, [first, last]);
  const peak = Math.max(Math.abs(min), Math.abs(max));
  return Number.isNaN(rms) ? null : { peak, rms, recoveryS: Number.NaN, missingS };
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
 * What an event began: the session's window, measured on every sample by the server. Of an event that
 * began none, such as a load that ends, peak and rms of the samples held up to the next event.
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
    return { untilS: nextS, read: (lane) => measureHeld(ring, lane + 1, event.time_s, nextS) };
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
