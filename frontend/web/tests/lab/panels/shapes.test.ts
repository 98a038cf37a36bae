import { describe, expect, it } from "vitest";
import type { Configuration } from "../../../src/core/api/types";
import { firstOf } from "../../../src/core/schema";
import { coursePath, listSchemas, readLevels, writeLevels } from "../../../src/lab/panels/shapes";

describe("steps", () => {
  it("between two levels are a list", () => {
    expect(writeLevels({ low: -20, high: 20, hold: 0.7, count: 3 })).toBe(
      "0, -20\n0.7, 20\n1.4, -20\n2.1, 20",
    );
  });

  it("are the numbers of the list in SI, with any separator", () => {
    expect(readLevels("position", " 0, 0\n2 180\n\n4.5;-90\n")).toEqual({
      kind: "steps",
      time_s: [0, 2, 4.5],
      position_rad: [0, Math.PI, -Math.PI / 2],
    });
    expect(readLevels("stiffness", "0\t15\n1\t60,5\n1,25; 70,5\n2,5 80")).toMatchObject({
      time_s: [0, 1, 1.25, 2.5],
      stiffness_nm_per_rad: [15, 60.5, 70.5, 80],
    });
  });

  it("are rejected with the invalid line, or by their number", () => {
    expect(() => readLevels("position", "0, 0\n1, two\n")).toThrow("Line 2 is “1, two”");
    expect(() => readLevels("position", "0, 0\n\n3")).toThrow("Line 3 is “3”");
    expect(() => readLevels("position", "2,180")).toThrow("separated by a space");
    expect(() => readLevels("position", "0 1,000")).toThrow("Line 1 is “0 1,000”");
    expect(() => readLevels("position", "0, 0, 1")).toThrow("a time and a level");
    expect(() => readLevels("position", " \n")).toThrow("0 lines; expected 1 to 200");
    expect(() =>
      readLevels("position", writeLevels({ low: 0, high: 1, hold: 1, count: 200 })),
    ).toThrow("201 lines");
  });
});

describe("the default steps", () => {
  const limits = { stiffness_min_nm_per_rad: 0.2, stiffness_max_nm_per_rad: 15 };
  const begin = (stiffness: object) =>
    firstOf(listSchemas("stiffness", { stiffness, limits } as unknown as Configuration).steps);

  it("start at the current stiffness and stay in the range of the actuator", () => {
    const at = (nm: number) => begin({ kind: "constant", stiffness_nm_per_rad: nm });
    expect(at(4)).toMatchObject({ low: 4, high: 8, levels: "0, 4\n2, 8\n4, 4\n6, 8\n8, 4" });
    expect(at(9)).toMatchObject({ low: 9, high: 15 });
    expect(begin({ kind: "sine" })).toMatchObject({ low: 1.73, high: 3.46 });
  });
});

describe("the preview", () => {
  it("has the maximum at the top and time to the right", () => {
    expect(coursePath([0, 1, 2], [-1, 1, 0], 100, 50)).toBe("0.00,50.00 50.00,0.00 100.00,25.00");
  });

  it("draws a constant in the middle", () => {
    expect(coursePath([0, 1], [3, 3], 10, 10)).toBe("0.00,5.00 10.00,5.00");
  });
});
