import { describe, expect, it } from "vitest";
import type { Metrics, WindowState } from "../src/api/types";
import { recoveryOf, sinceOf } from "../src/layout/window";

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
    expect(sinceOf(window("start", ""))).toBe("Since the start");
    expect(sinceOf(window("load", "3 kg load"))).toBe("Since 3 kg load at 5.00 s");
    expect(sinceOf(window("change", "NDOBC → FL"))).toBe("Since NDOBC → FL at 5.00 s");
    expect(sinceOf(window("change", "Gains changed"))).toBe("Since gains changed at 5.00 s");
  });
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

  it("is nothing without a load, or for a law that was not there when it came", () => {
    expect(recoveryOf(metrics(0.2), null).seconds).toBeNull();
    expect(recoveryOf(null, window("load", "3 kg load")).words).toBe("\u2013");
  });
});
