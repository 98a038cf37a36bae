import { describe, expect, it } from "vitest";
import { framesToPass } from "../../../src/core/plots/pace";

describe("frames", () => {
  it("are not taken from a view that is drawn quickly", () => {
    expect(framesToPass(16, 16)).toBe(0);
  });

  it("go to the plots where the view is slow, which still is drawn twice a second", () => {
    const passed = framesToPass(155, 35);
    expect((155 + passed * 35) / (passed + 1)).toBeLessThanOrEqual(50.1);
    expect(155 + passed * 35).toBeLessThanOrEqual(500);
    expect(framesToPass(600, 200)).toBe(1);
  });
});
