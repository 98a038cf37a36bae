import { describe, expect, it } from "vitest";
import { buildReference, drawCourse, FIRST, INPUTS, type Typed } from "../src/controls/shapes";

describe("references from what is typed", () => {
  it("steps alternate between two levels, in SI", () => {
    const typed = { ...FIRST.position, low: "0", high: "180", hold: "2", count: "3" };
    expect(buildReference("position", "steps", typed)).toEqual({
      kind: "steps",
      time_s: [0, 2, 4, 6],
      position_rad: [0, Math.PI, 0, Math.PI],
    });
  });

  it("stiffness stays in its own unit", () => {
    expect(buildReference("stiffness", "minimum_jerk", FIRST.stiffness)).toEqual({
      kind: "minimum_jerk",
      start_nm_per_rad: 15,
      end_nm_per_rad: 60,
      duration_s: 5,
    });
  });

  it("a chirp has its frequencies and its angle", () => {
    const chirp = buildReference("position", "chirp", { ...FIRST.position, amplitude: "90" });
    expect(chirp).toMatchObject({ amplitude_rad: Math.PI / 2, start_hz: 0.1, end_hz: 1 });
  });

  it("is nothing while a number that it needs is missing, and needs no other", () => {
    for (const shape of Object.keys(INPUTS) as Typed[]) {
      for (const name of INPUTS[shape]) {
        expect(buildReference("position", shape, { ...FIRST.position, [name]: " " })).toBeNull();
      }
    }
    expect(buildReference("position", "chirp", { ...FIRST.position, low: "" })).not.toBeNull();
  });
});

describe("the picture before", () => {
  it("has the greatest on top and time to the right", () => {
    expect(drawCourse([0, 1, 2], [-1, 1, 0], 100, 50)).toBe("0.00,50.00 50.00,0.00 100.00,25.00");
  });

  it("draws what stands still in the middle", () => {
    expect(drawCourse([0, 1], [3, 3], 10, 10)).toBe("0.00,5.00 10.00,5.00");
  });
});
