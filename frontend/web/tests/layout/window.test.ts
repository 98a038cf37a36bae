import { describe, expect, it, vi } from "vitest";
import type { BenchState, Metrics, WindowState } from "../../src/core/api/types";
import { text as page } from "../../src/core/text/en";
import { text as replay } from "../../src/core/text/replay";
import { bestIn, hasEnded, recoveryOf, sinceOf } from "../../src/layout/window";

const window = (
  kind: WindowState["kind"],
  label: string,
  end: number | null = null,
): WindowState => ({
  kind,
  label,
  start_tick: 5000,
  start_s: 5,
  end_tick: end === null ? null : end * 1000,
  end_s: end,
});
const metrics = (seconds: number | null) => ({ recovery_time_s: seconds }) as Metrics;

describe("a window", () => {
  it("says since when and since what", () => {
    expect(sinceOf(window("start", ""))).toBe("From the start");
    expect(sinceOf(window("load", "3 kg load"))).toBe("3 kg load, since 5.00 s");
    expect(sinceOf(window("change", "NDOBC → FL"))).toBe("NDOBC → FL, since 5.00 s");
    expect(sinceOf(window("change", "Gains changed"))).toBe("Gains changed, since 5.00 s");
    expect(sinceOf(window("stop", "Stop"))).toBe("Stop, since 5.00 s");
  });

  it("has a best where all lanes are simulated, none where one of them is a bench", () => {
    expect(bestIn({ bench: null }, [0.2, 0.1])).toBe(1);
    expect(bestIn({ bench: {} as BenchState }, [0.2, 0.1])).toBe(-1);
  });
});

it("knows a lane that ended by its numbers, which half a second without any takes away", () => {
  const state = { time_s: 9, window: window("load", "3 kg load off") };
  expect(hasEnded({ in_window: null }, state)).toBe(true);
  expect(hasEnded({ in_window: metrics(null) }, state)).toBe(false);
  expect(hasEnded({ in_window: null }, { ...state, time_s: 5.4 })).toBe(false);
});

it("says it in the words of the replay and the overlay", async () => {
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
  expect(page.compare.rms).toBe(replay.numbers.rms);
  expect(page.readout.peak).toBe(replay.numbers.peak);
  expect(page.overlay.steadyStateError).toBe(replay.numbers.settled);
  expect(page.overlay.recovery).toBe(page.compare.recovery);
});

describe("the recovery from a load", () => {
  const words = (seconds: number | null, end: number | null) =>
    recoveryOf(metrics(seconds), window("load", "3 kg load", end)).words;

  it("keeps its value after a change", () => {
    expect(words(0.2, null)).toBe("0.20");
    expect(words(0.2, 9)).toBe("0.20");
  });

  it("is still to come, or did not come before something was changed", () => {
    expect(words(null, null)).toBe("not yet");
    expect(words(null, 9)).toBe("not by 9.00");
  });

  it("is none while the error is large again, as under a load that grows", () => {
    const load = window("load", "Series torque");
    const grown = {
      ...metrics(0),
      peak_position_error_rad: 0.53,
      steady_state_position_error_rad: 0.5,
    };
    const recovery = recoveryOf(grown, load);
    expect(recovery.seconds).toBeNull();
    expect(recovery.words).toBe("not now");
    expect(recovery.hint).toContain("0.00 s from series torque at 5.00 s on");
    const small = { ...grown, steady_state_position_error_rad: 0.01 };
    expect(recoveryOf(small, load).words).toBe("0.00");
  });

  it("is nothing without a load, or for a law that was not there when it came", () => {
    expect(recoveryOf(metrics(0.2), null).seconds).toBeNull();
    expect(recoveryOf(null, window("load", "3 kg load")).words).toBe("\u2013");
  });
});
