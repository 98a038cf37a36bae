import { describe, expect, it } from "vitest";
import openapi from "../../../../docs/openapi.json?raw";
import { FIELDS } from "../../src/core/quantities";
import { parseNumber, readNumber, stepNumber } from "../../src/core/readnumber";
import { quantityOfSchema } from "../../src/core/schema";

const reasonOf = (typed: string, demand = {}) => {
  const reading = readNumber(typed, demand);
  return "reason" in reading ? reading.reason : reading.value;
};

describe("a typed number", () => {
  it.each([
    ["12.5", 12.5],
    ["12,5", 12.5],
    ["0,4", 0.4],
    ["0,125", 0.125],
    ["12.345", 12.345],
    ["1234,567", 1234.567],
    ["-12,5", -12.5],
    ["\u22125", -5],
    ["\u20135", -5],
    ["\uff0d\uff11\uff12\uff0e\uff15", -12.5],
    ["\uff11\uff0c\uff15", 1.5],
    ["\u0661\u0662\u066b\u0665", 12.5],
    ["\u200f-\u06f1\u06f2", -12],
    ["+3", 3],
    [".5", 0.5],
    [",5", 0.5],
    ["5,", 5],
    ["007", 7],
    ["0,0", 0],
    ["1e3", 1000],
    ["1,5E-3", 0.0015],
    ["1e-7", 1e-7],
    ["\u00a0 12,5\u202f\n", 12.5],
  ])("%j is %d", (typed, value) => {
    expect(parseNumber(typed)).toEqual({ value });
  });

  it.each([
    ["", "no number"],
    [" \t", "no number"],
    ["1,000", "can mean 1000 or 1.000"],
    ["-12,345", "can mean -12345 or -12.345"],
    ["\uff11\uff0c\uff10\uff10\uff10", "can mean 1000 or 1.000"],
    ["1.234,5", "more than one separator"],
    ["1,234.5", "more than one separator"],
    ["1,234,567", "more than one separator"],
    ["1.234.567", "more than one separator"],
    ["12,5,3", "more than one separator"],
    ["1..5", "more than one separator"],
    ["1 000", "more than one separator or a space"],
    ["1\u202f000", "or a space"],
    ["1'000", "more than one separator"],
    ["1_000", "more than one separator"],
    ["\u0661\u066c\u0660\u0660\u0660", "more than one separator"],
    ["1e400", "too large"],
    ["-1e999", "too large"],
    ["1e-400", "too close to zero"],
    ["0x10", "not a number"],
    ["0b1", "not a number"],
    ["1n", "not a number"],
    ["Infinity", "not a number"],
    ["NaN", "not a number"],
    ["12.5\u00b0", "not a number"],
    ["12,5 Hz", "not a number"],
    ["10\u00b2", "not a number"],
    ["\u00bd", "not a number"],
    ["--5", "not a number"],
    ["5-", "not a number"],
    ["- 5", "not a number"],
    ["1e", "not a number"],
    ["e5", "not a number"],
    ["1e1,5", "not a number"],
    ["-", "not a number"],
    [",", "not a number"],
    ["\u2013", "not a number"],
    ["1/2", "not a number"],
    ["1+1", "not a number"],
    ["\u4e09", "not a number"],
  ])("%j is rejected: %s", (typed, reason) => {
    expect(reasonOf(typed)).toContain(reason);
  });

  it("is rejected with unit and bounds", () => {
    const frequency = { label: "Frequency", unit: "Hz", min: 0, max: 5 };
    const required = "Required: a number from 0 to 5 Hz.";
    expect(reasonOf("12,5,3", frequency)).toContain(required);
    const outside = "Hz is out of range (from 0 to 5 Hz). The value is unchanged.";
    expect(reasonOf("9,5", frequency)).toBe(`Frequency: 9.5 ${outside}`);
    expect(reasonOf("-1", frequency)).toBe(`Frequency: \u22121 ${outside}`);
    expect(reasonOf("5", frequency)).toBe(5);
    expect(reasonOf("", { unit: "s" })).toContain("a number in s.");
    expect(reasonOf("x", { min: 1, isInteger: true })).toContain("a whole number at least 1.");
    expect(reasonOf("2,5", { isInteger: true })).toContain("2.5 is not a whole number.");
    expect(reasonOf("12,0", { isInteger: true })).toBe(12);
    expect(reasonOf("9007199254740993", { isInteger: true })).toContain("not a whole number");
  });
});

describe("a step of an arrow key", () => {
  it.each([
    [12.5, 1, {}, undefined, 13.5],
    [0.2, -1, { min: 0 }, undefined, 0.19],
    [0.3, 10, {}, 0.1, 1.3],
    [0, 1, { max: 50 }, undefined, 0.1],
    [128, 1, { isInteger: true }, undefined, 129],
    [1995, 10, { isInteger: true, max: 2000 }, undefined, 2000],
    [-1, -10, { min: -5 }, 1, -5],
  ])("from %d by %d", (value, count, demand, step, next) => {
    expect(stepNumber(value, count, demand, step)).toBe(next);
  });
});

describe("the bounds of the page's own fields", () => {
  const { schemas } = JSON.parse(openapi).components;
  it.each([
    ["SinePosition", "amplitude_rad"],
    ["SineStiffness", "amplitude_nm_per_rad"],
    ["ConstantLoad", "torque_nm"],
    ["ObserverBandwidth", "bandwidth_rad_per_s"],
  ] as const)("are those of the API: %s.%s", (schema, name) => {
    const { prefixItems, ...plain } = schemas[schema].properties[name];
    const { minimum, maximum } = prefixItems?.[0] ?? plain;
    const { min, max, factor = 1 } = quantityOfSchema(FIELDS[name]);
    expect([min, max]).toEqual([
      expect.closeTo(minimum * factor),
      expect.closeTo(maximum * factor),
    ]);
  });
});
