import { describe, expect, it, vi } from "vitest";
import type {
  BenchState,
  LaneRow,
  Metrics,
  SessionState,
  WindowState,
} from "../../src/core/api/types";
import { SampleRing } from "../../src/core/stream/ring";
import { t } from "../../src/core/text/t";

import {
  bestIn,
  hasEnded,
  readCurrentError,
  recoveryNameOf,
  recoveryOf,
  sinceOf,
} from "../../src/layout/window";

const window = (kind: WindowState["kind"], label: string): WindowState => ({
  kind,
  label,
  start_tick: 5000,
  start_s: 5,
  end_tick: null,
  end_s: null,
});
/** Lanes under a load of 5 s, whose present controllers began at these ticks. */
const lanesFrom = (...ticks: number[]): Pick<SessionState, "bench" | "lanes" | "window"> => ({
  bench: null,
  window: window("change", "FL added"),
  lanes: ticks.map((start_tick) => ({ segments: [{ start_tick }] }) as LaneRow),
});
const metrics = (seconds: number | null) => ({ recovery_time_s: seconds }) as Metrics;

describe("a window", () => {
  it("names the contents of the recovery time of a bench", () => {
    expect(recoveryNameOf({ bench: null }).name).toBe("Recovery time");
    expect(recoveryNameOf({ bench: {} as BenchState }).name).toBe("Mark to recovery");
  });

  it("is described by its event and its start time", () => {
    expect(sinceOf(window("start", ""))).toBe("From the start");
    expect(sinceOf(window("load", "3 kg load"))).toBe("3 kg load, since 5.00 s");
    expect(sinceOf(window("change", "NDOBC → FL"))).toBe("NDOBC → FL, since 5.00 s");
    expect(sinceOf(window("change", "Gains changed"))).toBe("Gains changed, since 5.00 s");
    expect(sinceOf(window("stop", "Stop"))).toBe("Stop, since 5.00 s");
  });

  it("has a best value if all lanes are simulated, and none if one of them is a bench", () => {
    const state = lanesFrom(0, 0);
    expect(bestIn(state, [0.2, 0.1])).toEqual([1]);
    expect(bestIn({ ...state, bench: {} as BenchState }, [0.2, 0.1])).toEqual([]);
  });
});

it("marks no best value in a window that started with a single controller", () => {
  expect(bestIn(lanesFrom(0, 5000), [0.002, 12.1])).toEqual([]);
  expect(bestIn(lanesFrom(0, 3000), [0.002, 12.1])).toEqual([0]);
  expect(bestIn(lanesFrom(5000, 5000), [0.002, 12.1])).toEqual([0]);
});

it("marks no best value where controllers exchanged their lanes and started from other states", () => {
  const exchanged = lanesFrom(5000, 5000);
  const numbers = [
    [1, 2],
    [2, 1],
  ];
  exchanged.lanes = numbers.map(([before, now]) => ({
    segments: [
      { number: before, start_tick: 0 },
      { number: now, start_tick: 5000 },
    ],
  })) as LaneRow[];
  expect(bestIn(exchanged, [0.002, 12.1])).toEqual([]);
  const later = { ...exchanged, window: { ...window("load", "3 kg load"), start_tick: 9000 } };
  expect(bestIn(later, [0.002, 12.1])).toEqual([0]);
});

it("shows no error of a controller before its first sample", () => {
  const ring = new SampleRing(10, ["position_error_rad"], [7]);
  const values = Float32Array.of(0.1, 0.2);
  const batch = { run: 1, firstTick: 4990, stride: 5, count: 2, missed: 0, lanes: [7], values };
  ring.append(batch, 0.001);
  expect(readCurrentError(ring, 1, 4.995)).toBeCloseTo(0.2);
  expect(readCurrentError(ring, 1, 4.998)).toBeNaN();
});

it("reports a lane as ended if it has no metrics half a second after the start of the window", () => {
  const state = { time_s: 9, window: window("load", "3 kg load off") };
  expect(hasEnded({ in_window: null }, state)).toBe(true);
  expect(hasEnded({ in_window: metrics(null) }, state)).toBe(false);
  expect(hasEnded({ in_window: null }, { ...state, time_s: 5.4 })).toBe(false);
});

it("uses the same words as the replay and the overlay", async () => {
  vi.stubGlobal("location", { search: "" });
  const { describeMeasured } = await import("../../src/runs/list/measured");
  for (const [kind, label] of [
    ["load", "3 kg load"],
    ["start", ""],
  ] as const) {
    const live = sinceOf(window(kind, label));
    const recorded = { label, start_s: 5, end_s: 9, is_whole: false, lanes: [], load_ended: false };
    const message = describeMeasured(recorded);
    expect(message.split(",")[0]).toBe(live.split(",")[0]);
  }
  expect(t("compare.rms")).toBe(t("replay.numbers.rms"));
  expect(t("readout.peak")).toBe(t("replay.numbers.peak"));
  expect(t("overlay.steadyStateError")).toBe(t("replay.numbers.settled"));
  expect(t("overlay.recovery")).toBe(recoveryNameOf({ bench: null }).name);
});

describe("the recovery time", () => {
  const words = (kind: WindowState["kind"], seconds: number | null) =>
    recoveryOf(metrics(seconds), window(kind, "3 kg load")).words;

  it("is that of a window that a load or its removal started", () => {
    expect(words("load", 0.2)).toBe("0.20");
    expect(words("unload", 0.2)).toBe("0.20");
    expect(words("load", null)).toBe("not yet");
  });

  it("is empty in another window, after any load", () => {
    expect(words("change", 0.2)).toBe("\u2013");
    expect(words("start", 0.2)).toBe("no load yet");
  });

  it("is empty while the error is large again, as under a growing load", () => {
    const load = window("load", "Series torque");
    const grown = {
      ...metrics(0),
      peak_position_error_rad: 0.53,
      steady_state_position_error_rad: 0.5,
    };
    const recovery = recoveryOf(grown, load);
    expect(recovery.seconds).toBeNull();
    expect(recovery.words).toBe("not recovered");
    expect(recovery.hint).toContain("0.00 s after series torque at 5.00 s");
    const small = { ...grown, steady_state_position_error_rad: 0.01 };
    expect(recoveryOf(small, load).words).toBe("0.00");
  });

  it("is empty for a lane without metrics", () => {
    expect(recoveryOf(null, window("load", "3 kg load")).words).toBe("\u2013");
  });
});
