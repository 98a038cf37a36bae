import "../../browserless";
import { expect, it } from "vitest";
import type { SessionState } from "../../../src/core/api/types";
import {
  acceptState,
  mergeProgress,
  type Progress,
  session,
} from "../../../src/core/state/session";

const segment = (name: string, end_tick: number | null) => ({ name, end_tick });
const ended = (start_tick: number, end_tick: number) => ({ start_tick, end_tick });
const stateAt = (tick: number, rest: object) =>
  ({ run_number: 1, rate_hz: 1000, tick, ...rest }) as unknown as SessionState;

const KNOWN = stateAt(500, {
  law: "fl",
  events: [{ tick: 100 }, { tick: 400 }],
  ended_windows: [ended(0, 100), ended(100, 400)],
  lanes: [
    { id: 1, segments: [segment("FL", 400), segment("NDOBC", null)] },
    { id: 2, segments: [segment("FL", null)] },
  ],
});

it("keeps earlier events and applies a message from its tick on", () => {
  const progress = stateAt(700, {
    events: [{ tick: 600 }],
    ended_windows: [ended(400, 600)],
    lanes: [
      { id: 1, segments: [segment("NDOBC", 600), segment("NDOBC β 70", null)] },
      { id: 3, segments: [segment("FL", null)] },
    ],
  });
  const joined = mergeProgress(KNOWN, progress as Progress, 500);
  expect(joined.events.map(({ tick }) => tick)).toEqual([100, 400, 600]);
  expect(joined.ended_windows.map(({ end_tick }) => end_tick)).toEqual([100, 400, 600]);
  expect(joined.lanes.map((lane) => lane.segments.map(({ name }) => name))).toEqual([
    ["FL", "NDOBC", "NDOBC β 70"],
    ["FL"],
  ]);
});

it("does not apply changes again that a response has already reported", () => {
  const progress = stateAt(500, {
    events: [{ tick: 400 }],
    ended_windows: [ended(100, 400)],
    lanes: KNOWN.lanes,
  });
  expect(mergeProgress(KNOWN, progress as Progress, 300)).toEqual(KNOWN);
});

it("discards its events at a complete message, and windows that ended a minute ago", () => {
  const progress = stateAt(500, { events: [], ended_windows: [] });
  expect(mergeProgress(KNOWN, progress as Progress, 0).events).toEqual([]);
  const later = mergeProgress(KNOWN, stateAt(60_200, { ended_windows: [] }) as Progress, 60_000);
  expect(later.ended_windows.map(({ end_tick }) => end_tick)).toEqual([400]);
});

it("keeps the fields that a message omits", () => {
  const joined = mergeProgress(KNOWN, { run_number: 1, tick: 900 }, 800);
  expect(joined).toEqual({ ...KNOWN, tick: 900 });
});

it("keeps the newer state of a paused session when an older answer arrives late", () => {
  const pausedAfter = (commands: number) =>
    stateAt(500, { revision: `5f.1.${commands}`, lanes: [], law: `law ${commands}` });
  session.value = pausedAfter(9);
  acceptState(pausedAfter(10));
  acceptState(pausedAfter(9));
  expect(session.value).toEqual(pausedAfter(10));
  acceptState({ run_number: 1, tick: 500, speed: 2 });
  expect(session.value).toEqual({ ...pausedAfter(10), speed: 2 });
  acceptState({ ...pausedAfter(0), run_number: 2 });
  expect(session.value.run_number).toBe(2);
});
