import { describe, expect, it } from "vitest";
import { includeBounds, niceRange, niceStep } from "../../../src/core/plots/range";

describe("niceStep", () => {
  it.each([
    [0.9, 1],
    [1, 1],
    [1.2, 2],
    [2.2, 2.5],
    [3, 5],
    [7, 10],
    [0.0004, 0.0005],
  ])("%s becomes %s", (value, step) => {
    expect(niceStep(value)).toBeCloseTo(step, 12);
  });
});

describe("niceRange", () => {
  it("contains the data and ends on round numbers", () => {
    expect(niceRange(-60, 60, 2)).toEqual([-80, 80]);
  });

  it("rests while the data move a little", () => {
    expect(niceRange(-59.8, 60, 2)).toEqual(niceRange(-60, 59.7, 2));
  });

  it("never shows less than the span", () => {
    const [low, high] = niceRange(15, 15, 2);
    expect(high - low).toBeGreaterThanOrEqual(2);
    expect((low + high) / 2).toBeCloseTo(15, 9);
  });

  it("has limits without data", () => {
    expect(niceRange(null, null, 2)).toEqual([-1, 1]);
    expect(niceRange(Number.NaN, 1, 2)).toEqual([-1, 1]);
  });
});

describe("includeBounds", () => {
  it("leaves distant bounds out", () => {
    expect(includeBounds(-2, 2, [5, 15])).toEqual([-2, 2]);
  });

  it("shows a bound that the data come near to", () => {
    const [low, high] = includeBounds(-1, 4.5, [5, 15]);
    expect(high).toBeGreaterThan(5);
    expect(high).toBeLessThan(15);
    expect(low).toBe(-high);
  });
});
