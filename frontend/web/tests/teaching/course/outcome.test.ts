import { describe, expect, it } from "vitest";
import {
  type Course,
  judge,
  measure,
  type Numbers,
  sliceCourse,
} from "../../../src/teaching/course/outcome";

const FL: Numbers = {
  beforeDeg: 0.04,
  peakDeg: 12.1,
  steadyDeg: 12.08,
  stiffnessBefore: 0.001,
  stiffnessSteady: 0.43,
};
const NDOBC: Numbers = {
  beforeDeg: 0.0012,
  peakDeg: 4.1,
  steadyDeg: 0.0013,
  stiffnessBefore: 0.0001,
  stiffnessSteady: 0.0001,
};
const held = (findings: { holds: boolean }[]) => findings.map(({ holds }) => holds);

describe("a figure's outcome", () => {
  const timeS = Array.from({ length: 2000 }, (_, index) => index / 100);
  const error = timeS.map((time) => (time < 5 ? 0.001 : time < 6 ? 0.2 : 0.002));
  const course: Course = {
    timeS,
    positionRad: [error, error.map(() => 0)],
    stiffness: [error, error],
  };

  it("is measured in the paper's windows", () => {
    const degrees = 180 / Math.PI;
    const { beforeDeg, peakDeg, steadyDeg } = measure(course, 0);
    expect(beforeDeg).toBeCloseTo(0.001 * degrees, 9);
    expect(peakDeg).toBeCloseTo(0.2 * degrees, 9);
    expect(steadyDeg).toBeCloseTo(0.002 * degrees, 9);
  });

  it("is cut out of a batch lane by lane", () => {
    const values = new Float32Array([0, 1, 2, 0, 3, 4, 0.5, 5, 6, 0.5, 7, 8]);
    const batch = { run: 1, firstTick: 0, stride: 1, count: 2, missed: 0, lanes: [1, 2], values };
    expect(sliceCourse(batch, 3)).toEqual({
      timeS: [0, 0.5],
      positionRad: [
        [1, 5],
        [3, 7],
      ],
      stiffness: [
        [2, 6],
        [4, 8],
      ],
    });
  });

  it("holds with the numbers of the reproduction, and not without", () => {
    expect(held(judge("4a", FL, NDOBC))).toEqual([true, true, true, true]);
    expect(held(judge("5", FL, NDOBC))).toEqual([true, true, true]);
    expect(held(judge("4b", NDOBC, FL))).toEqual([true, false, false, false]);
    const nothing = { ...FL, steadyDeg: Number.NaN };
    expect(judge("4a", nothing, NDOBC)[1]?.holds).toBe(false);
  });
});
