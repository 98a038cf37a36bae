import { describe, expect, it } from "vitest";
import { positionOf, STEPS, valueAt } from "../../../src/core/scale";
import { bestOf } from "../../../src/core/widgets/tables";

describe("slider scale", () => {
  const even = { min: -90, max: 90, step: 1 };
  const byRatio = { min: 1.7, max: 150.56, logarithmic: true };

  it("reaches both ends exactly", () => {
    for (const range of [even, byRatio]) {
      expect(valueAt(0, range)).toBe(range.min);
      expect(valueAt(STEPS, range)).toBe(range.max);
    }
  });

  it("inverts its values", () => {
    expect(valueAt(positionOf(30, even), even)).toBe(30);
    expect(valueAt(positionOf(60, byRatio), byRatio)).toBeCloseTo(60, 0);
  });

  it("limits values beyond its ends", () => {
    expect(positionOf(500, byRatio)).toBe(STEPS);
    expect(positionOf(-500, even)).toBe(0);
  });
});

describe("bestOf", () => {
  it.each([
    ["the clearly smallest", [3, 1, 2], 1],
    ["none of two that are nearly equal", [1, 1.02], -1],
    ["none of two that are nothing", [1e-9, 1e-12], -1],
    ["the only one that recovered", [0.8, Number.POSITIVE_INFINITY], 0],
    ["none where none recovered", [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY], -1],
    ["none where a value is missing", [1, null], -1],
  ])("finds %s", (_, values, best) => {
    expect(bestOf(values)).toBe(best);
  });
});
