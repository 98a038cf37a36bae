import { describe, expect, test } from "vitest";
import { pathOf, shareOf } from "../../src/design/curves";
import { errorAxis } from "../../src/design/erroraxis";
import { rangeOf } from "../../src/design/words";

const RANGE = { parameter: "link_inertia_kg_m2", symbol: "M", present: 0.67 };

describe("charts of a design", () => {
  test("a logarithmic axis has equal ways for equal ratios", () => {
    const axis = { from: 0.1, to: 100, ticks: [], label: "Hz", isLogarithmic: true };
    expect(shareOf(0.1, axis)).toBeCloseTo(0);
    expect(shareOf(1, axis)).toBeCloseTo(1 / 3);
    expect(shareOf(100, axis)).toBeCloseTo(1);
  });

  test("no points are no path", () => {
    const axis = { from: 0, to: 1, ticks: [], label: "" };
    expect(pathOf([], axis, axis)).toBe("");
    expect(
      pathOf(
        [
          [0, 0],
          [1, 1],
        ],
        axis,
        axis,
      ),
    ).toMatch(/^M.*L/);
  });

  test("the axis of the error holds both curves and the zero", () => {
    const axis = errorAxis([
      [
        [0, 0],
        [0.1, -4.1],
      ],
      [
        [0, 0],
        [0.1, -5.9],
      ],
    ]);
    expect(axis.from).toBeLessThan(-5.9);
    expect(axis.to).toBeGreaterThan(0);
    expect(axis.ticks).toContain(0);
  });
});

describe("how wrong a parameter may be", () => {
  test("both ends, one, or none", () => {
    expect(rangeOf({ ...RANGE, low: 0.2317, high: 3.844 })).toBe("0.23 – 3.84");
    expect(rangeOf({ ...RANGE, low: null, high: 4.39 })).toBe("up to 4.39");
    expect(rangeOf({ ...RANGE, low: 0.25, high: null })).toBe("from 0.25");
    expect(rangeOf({ ...RANGE, low: null, high: null })).toBe("all");
  });
});
