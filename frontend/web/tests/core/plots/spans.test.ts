import { describe, expect, it } from "vitest";
import { clampSpan, liveSpan, zoomSpan } from "../../../src/core/plots/spans";
import { SampleRing } from "../../../src/core/stream/ring";

describe("the displayed time span", () => {
  it("zooms around a fixed time, from 50 ms to 60 s", () => {
    expect(zoomSpan({ from: 10, to: 30 }, 0.5, 15)).toEqual({ from: 12.5, to: 22.5 });
    const near = zoomSpan({ from: 0, to: 0.06 }, 0.01, 0.03);
    expect(near.to - near.from).toBeCloseTo(0.05, 9);
    const far = zoomSpan({ from: 0, to: 50 }, 10, 25);
    expect(far.to - far.from).toBeCloseTo(60, 9);
  });

  it("is limited so that samples stay visible", () => {
    expect(clampSpan({ from: -30, to: -10 }, 0, 100)).toEqual({ from: -10, to: 10 });
    expect(clampSpan({ from: 95, to: 115 }, 0, 100)).toEqual({ from: 90, to: 110 });
    expect(clampSpan({ from: 5, to: 15 }, 0, 100)).toEqual({ from: 5, to: 15 });
    expect(clampSpan({ from: 5, to: 15 }, Number.NaN, Number.NaN)).toEqual({ from: 5, to: 15 });
  });

  it("starts at zero and follows the newest sample", () => {
    expect(liveSpan(new SampleRing(1, []), 20)).toEqual({ from: 0, to: 20 });
  });
});
