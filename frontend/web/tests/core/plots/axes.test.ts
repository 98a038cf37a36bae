import "../../browserless";
import { describe, expect, it } from "vitest";
import {
  includeBounds,
  niceRange,
  niceStep,
  placeWords,
  timeStep,
} from "../../../src/core/plots/axes";
import { t } from "../../../src/core/text/t";

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

  it("does not change while the data change slightly", () => {
    expect(niceRange(-59.8, 60, 2)).toEqual(niceRange(-60, 59.7, 2));
  });

  it("is never smaller than the minimum span", () => {
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
  it("ignores distant bounds", () => {
    expect(includeBounds(-2, 2, [5, 15])).toEqual([-2, 2]);
  });

  it("includes a bound near the data", () => {
    const [low, high] = includeBounds(-1, 4.5, [5, 15]);
    expect(high).toBeGreaterThan(5);
    expect(high).toBeLessThan(15);
    expect(low).toBe(-high);
  });
});

describe("the numbers of the time axis", () => {
  const DIGIT_PX = 7;
  it.each([
    [280, 0.05, 1000.065],
    [280, 60, 3600],
    [420, 0.05, 12345.061],
    [420, 20, 1003.7],
    [900, 0.3, 1000.1],
    [900, 5, 9.99],
  ])("on %s px of %s s up to %s s are complete and do not overlap", (width, length, to) => {
    const from = to - length;
    const step = timeStep({ from, to }, width);
    const perStep = (step / length) * width;
    const words: [number, number][] = [];
    for (let index = Math.ceil(from / step - 1e-9); index * step <= to + 1e-9; index++) {
      const long =
        t("plots.timeTick", { seconds: Number((index * step).toFixed(4)) }).length * DIGIT_PX;
      const left = placeWords(((index * step - from) / length) * width, long, width, perStep);
      if (left !== null) words.push([left, left + long]);
    }
    expect(words.length).toBeGreaterThan(0);
    expect(words[0]?.[0]).toBeGreaterThanOrEqual(0);
    expect(words.at(-1)?.[1]).toBeLessThanOrEqual(width);
    words.slice(1).forEach(([left], index) => {
      expect(left).toBeGreaterThan((words[index] as [number, number])[1]);
    });
  });
});
