/** Metrics of a lane after an event, as in the table next to the plots. */
import type { SessionEvent, SessionState } from "../api/types";
import { controllerAt, type LaneSegments } from "../state/lanes";
import type { SampleRing } from "../stream/ring";
import { measureBetween } from "./statistics";

const ERROR = "position_error_rad";
const LATE_S = 0.1;

interface StepMetrics {
  peak: number;
  rms: number;
  /** Recovery time, s; null: not yet recovered, NaN: not measured. */
  recoveryS: number | null;
  /** Duration without values, s: the true peak may be higher. */
  missingS: number;
}

interface Step {
  /** End of the window, session time in s; infinity while it is open. */
  untilS: number;
  /** Metrics of the lane at an index among those shown; null if unknown. */
  read: (lane: number) => StepMetrics | null;
}

/** The error from one time up to before another; null if its beginning is no longer stored. */
function measureHeld(ring: SampleRing, lane: number, fromS: number, toS: number) {
  const first = ring.lowerBound(fromS);
  const last = Math.min(ring.length, ring.lowerBound(toS)) - 1;
  if (first > last || (first === 0 && ring.oldestTime > fromS + LATE_S)) return null;
  const { min, max, rms, missingS } = measureBetween(ring, ERROR, lane, [first, last]);
  const peak = Math.max(Math.abs(min), Math.abs(max));
  return Number.isNaN(rms) ? null : { peak, rms, recoveryS: Number.NaN, missingS };
}

/** The window that an event began: its end, and its metrics of the current lanes. */
function findWindow(state: SessionState, tick: number) {
  if (state.window.start_tick === tick) {
    return { endS: null, lanes: state.lanes.map((lane) => lane.in_window) };
  }
  const ended = state.ended_windows.find((window) => window.start_tick === tick);
  return ended && { endS: ended.end_s, lanes: ended.lanes };
}

/**
 * Metrics of the window that an event began, measured by the server on every sample. For an event
 * without a window, such as the end of a load: peak and rms of the stored samples up to the next
 * event.
 *
 * shown: controllers of the lanes in the plots, whose samples `ring` contains; present: those of
 * the session. nextS: time of the next event, s.
 */
export function findStep(
  state: SessionState,
  event: SessionEvent,
  nextS: number,
  { ring, shown, present }: { ring: SampleRing; shown: LaneSegments; present: LaneSegments },
): Step {
  const window = findWindow(state, event.tick);
  if (window === undefined) {
    return { untilS: nextS, read: (lane) => measureHeld(ring, lane + 1, event.time_s, nextS) };
  }
  const numberAt = (cast: LaneSegments, lane: number) =>
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
