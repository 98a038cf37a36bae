/** What is over in a session, as messages of the stream tell it once. */
import type { SessionState } from "../api/types";
import { LONGEST_WINDOW_S } from "../stream/rates";

/** After a change the whole state; between changes only the fields that move by themselves. */
export type Progress = Pick<SessionState, "run_number" | "tick"> & Partial<SessionState>;

const MAX_EVENTS = 200;

type Over = { end_tick: number | null };

/**
 * The state after a message, which tells events, ended windows and ended stretches of lanes from
 * its `sinceTick` on: those before are as they were known.
 */
export function joinPast(known: SessionState, told: Progress, sinceTick: number): SessionState {
  const joined = { ...known, ...told };
  if (sinceTick === 0) return joined;
  const firstTick = joined.tick - LONGEST_WINDOW_S * joined.rate_hz;
  const isBefore = ({ end_tick }: Over) =>
    end_tick !== null && end_tick < sinceTick && end_tick > firstTick;
  if (told.events !== undefined) {
    const before = known.events.filter(({ tick }) => tick < sinceTick);
    joined.events = [...before, ...told.events].slice(-MAX_EVENTS);
  }
  if (told.ended_windows !== undefined) {
    joined.ended_windows = [...known.ended_windows.filter(isBefore), ...told.ended_windows];
  }
  if (told.lanes !== undefined) {
    const pastOf = (lane: number) => known.lanes.find(({ id }) => id === lane)?.stretches ?? [];
    joined.lanes = told.lanes.map((lane) => ({
      ...lane,
      stretches: [...pastOf(lane.id).filter(isBefore), ...lane.stretches],
    }));
  }
  return joined;
}
