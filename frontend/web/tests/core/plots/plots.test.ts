import "../../browserless";
import { describe, expect, it, vi } from "vitest";
import { shareOfList } from "../../../src/core/plots/plots";

vi.mock("uplot", () => ({ default: class {} }));

describe("the height of a plot in the list", () => {
  it.each([
    { height: 536, least: 72, together: 5 },
    { height: 535, least: 72, together: 4 },
    { height: 520, least: 92, together: 4 },
    { height: 330, least: 62, together: 3 },
    { height: 500, least: 72, together: 4, head: 26 },
    { height: 500, least: 72, together: 3, head: 50 },
  ])("is that of $together complete plots in $height px", ({ height, least, together, head }) => {
    const share = shareOfList(height, least, head);
    expect(together * share + 46).toBeCloseTo(height + 1, 9);
    expect(share).toBeGreaterThanOrEqual(least + (head ?? 26));
  });

  it("is the complete list if a single plot does not fit", () => {
    expect(shareOfList(100, 92)).toBe(55);
    expect(shareOfList(0, 92)).toBe(0);
  });
});
