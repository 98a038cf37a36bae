import { beforeAll, describe, expect, it, vi } from "vitest";
import type { Metrics, SessionEvent, SessionState } from "../../../src/core/api/types";
import type { LaneSegments } from "../../../src/core/state/lanes";
import { SampleRing } from "../../../src/core/stream/ring";
import { stubBrowser } from "../../browser";

stubBrowser();
vi.stubGlobal("document", { baseURI: "http://lab/", documentElement: { dataset: {} } });
vi.stubGlobal("location", { search: "" });
const { findStep } = await import("../../../src/core/plots/stepmetrics");

const metrics = (peak: number): Metrics =>
  ({
    peak_position_error_rad: peak,
    rms_position_error_rad: peak / 3,
    recovery_time_s: 0.21,
  }) as Metrics;
const event = (tick: number): SessionEvent => ({
  tick,
  time_s: tick / 1000,
  kind: "load_on",
  label: "3 kg load on",
});
const segment = (number: number, name: string) => ({
  number,
  name,
  lineStyle: 0,
  hasEstimate: true,
  from: 0,
  to: Number.POSITIVE_INFINITY,
});
const BOTH: LaneSegments = [[segment(1, "NDOBC")], [segment(2, "FL")]];
const state = {
  window: { start_tick: 9000 },
  ended_windows: [{ start_tick: 5000, end_s: 9, lanes: [metrics(0.0723), metrics(0.21)] }],
  lanes: [{ in_window: metrics(0.01) }, { in_window: metrics(0.02) }],
} as unknown as SessionState;
const ring = new SampleRing(40, ["position_error_rad"], [1, 2]);

/** As in the stream: every fifth sample, with the maximum between two of them. */
beforeAll(() => {
  ring.append(
    {
      run: 1,
      firstTick: 5000,
      stride: 5,
      count: 20,
      missed: 0,
      lanes: [1, 2],
      values: new Float32Array(40).fill(0.0719),
    },
    0.001,
  );
});

describe("the metrics of an event", () => {
  const of = { ring, shown: BOTH, present: BOTH };

  it("are those of the window that it started, as in the table", () => {
    const ended = findStep(state, event(5000), 6, of);
    expect(ended.untilS).toBe(9);
    expect(ended.read(0)).toMatchObject({ peak: 0.0723, recoveryS: 0.21, missingS: 0 });
    const going = findStep(state, event(9000), 9.5, of);
    expect(going.untilS).toBe(Number.POSITIVE_INFINITY);
    expect(going.read(1)?.peak).toBe(0.02);
  });

  it("keep their lane if lanes were removed while the plots are frozen", () => {
    const present: LaneSegments = [[segment(2, "FL")]];
    const later = {
      ...state,
      ended_windows: [{ start_tick: 5000, end_s: 9, lanes: [metrics(0.21)] }],
    } as unknown as SessionState;
    const { read } = findStep(later, event(5000), 9, { ring, shown: BOTH, present });
    expect(read(1)?.peak).toBe(0.21);
    expect(read(0)).toBeNull();
  });

  it("are computed from the frozen samples if the event started no window", () => {
    const { untilS, read } = findStep(state, event(5005), 6, of);
    expect(untilS).toBe(6);
    expect(read(0)).toMatchObject({ recoveryS: Number.NaN, missingS: 0 });
    expect(read(0)?.peak).toBeCloseTo(0.0719, 6);
    expect(read(0)?.rms).toBeCloseTo(0.0719, 6);
  });

  it("are unknown if the start of the window is no longer stored", () => {
    expect(findStep(state, event(4005), 6, of).read(0)).toBeNull();
    expect(findStep(state, event(5105), 6, of).read(0)).toBeNull();
  });
});
