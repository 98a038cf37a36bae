import { describe, expect, it } from "vitest";
import {
  formatError,
  formatInput,
  formatLapse,
  formatNumber,
  formatSeconds,
  formatTime,
  toDegrees,
  toRadians,
} from "../../src/core/units";

describe("units", () => {
  it("converts radians to degrees and back", () => {
    expect(toDegrees(Math.PI / 3)).toBeCloseTo(60, 12);
    expect(toRadians(toDegrees(0.7))).toBeCloseTo(0.7, 15);
  });

  it.each([
    [12.0834, "12.1"],
    [-57.46, "−57.5"],
    [0.0013, "0.0013"],
    [-0.00001, "0.0000"],
    [1234.5, "1235"],
    [0, "0.00"],
    [null, "–"],
    [Number.NaN, "–"],
  ])("writes %s as %s", (value, shown) => {
    expect(formatNumber(value)).toBe(shown);
  });

  it.each([
    [0.00004, "0.000040"],
    [0.00128, "0.0013"],
    [12.083, "12.1"],
    [0, "0.0"],
    [null, "–"],
  ])("writes an error of %s as %s: a small error is not shown as zero", (value, shown) => {
    expect(formatError(value)).toBe(shown);
  });

  it("writes input fields briefly, with a plain minus", () => {
    expect(formatInput(toDegrees(1.0472))).toBe("60");
    expect(formatInput(-12.5)).toBe("-12.5");
    expect(formatInput(12960000)).toBe("12960000");
  });

  it("writes time as minutes and seconds", () => {
    expect(formatTime(0)).toBe("0:00.0");
    expect(formatTime(75.25)).toBe("1:15.2");
    expect(formatTime(59.999)).toBe("0:59.9");
  });
});

describe("formatSeconds", () => {
  it.each([
    [0, "0:00"],
    [12.9, "0:12"],
    [75.25, "1:15"],
    [3600, "60:00"],
  ])("%s s is %s", (seconds, shown) => {
    expect(formatSeconds(seconds)).toBe(shown);
  });

  it.each([
    [24.4e-6, "24 µs"],
    [182e-6, "182 µs"],
    [1.92e-3, "1.9 ms"],
    [0.25, "250 ms"],
    [2.4, "2.40 s"],
    [0, "0 µs"],
  ])("writes %f s in the most readable unit", (seconds, shown) => {
    expect(formatLapse(seconds)).toBe(shown);
  });
});
