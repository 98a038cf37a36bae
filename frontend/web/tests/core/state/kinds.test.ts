import "../../browserless";
import { describe, expect, it } from "vitest";
import type { FormField } from "../../../src/core/api/types";
import { quantityOfParameter } from "../../../src/core/quantities";
import { initialValues, readForm } from "../../../src/core/state/kinds";

const row = { symbol: "", kind: "number", default: null, low: null } as const;
const angle = { ...row, name: "amplitude_rad", meaning: "Amplitude", unit: "rad", high: 6.3 };
const lag = { ...row, name: "time_constant_s", meaning: "Time constant", unit: "s", high: 0.05 };
const ratio = { ...row, name: "static_ratio", meaning: "Breakaway", unit: "1", high: 5 };
const FORM: FormField[] = [
  { parameter: angle, first: Math.PI / 18 },
  { parameter: { ...lag, name: "duration_s", high: 3600 }, first: 5 },
];

describe("a form generated from a description", () => {
  it("has units and bounds of the screen: degrees, thousandths, or no unit", () => {
    expect(quantityOfParameter(angle)).toMatchObject({ label: "Amplitude", unit: "deg" });
    expect(quantityOfParameter(lag)).toMatchObject({ unit: "ms", factor: 1000 });
    expect(quantityOfParameter(ratio)).toEqual({ label: "Breakaway", unit: "", max: 5 });
  });

  it("starts with the default values in displayed units and returns SI", () => {
    const first = initialValues(FORM);
    expect(first).toEqual({ amplitude_rad: expect.closeTo(10, 12), duration_s: 5 });
    expect(readForm(FORM, { ...first, amplitude_rad: 90 })).toEqual({
      amplitude_rad: Math.PI / 2,
      duration_s: 5,
    });
  });
});
