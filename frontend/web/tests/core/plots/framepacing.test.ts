import { describe, expect, it } from "vitest";
import { framesToSkip } from "../../../src/core/plots/framepacing";

describe("frames", () => {
  it("are not taken from a fast 3D view", () => {
    expect(framesToSkip(16, 16)).toBe(0);
  });

  it("are given to the plots if the 3D view is slow, which is still drawn twice a second", () => {
    const passed = framesToSkip(155, 35);
    expect((155 + passed * 35) / (passed + 1)).toBeLessThanOrEqual(50.1);
    expect(155 + passed * 35).toBeLessThanOrEqual(500);
    expect(framesToSkip(600, 200)).toBe(1);
  });
});
