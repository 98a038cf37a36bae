import { describe, expect, it } from "vitest";
import { framesToSkip } from "../../../src/core/plots/framepacing";

describe("frames", () => {
  it("are not taken from a view that is drawn quickly", () => {
    expect(framesToSkip(16, 16)).toBe(0);
  });

  it("go to the plots where the view is slow, which still is drawn twice a second", () => {
    const passed = framesToSkip(155, 35);
    expect((155 + passed * 35) / (passed + 1)).toBeLessThanOrEqual(50.1);
    expect(155 + passed * 35).toBeLessThanOrEqual(500);
    expect(framesToSkip(600, 200)).toBe(1);
  });
});
