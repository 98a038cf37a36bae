import { describe, expect, it } from "vitest";
import { angleSeen, type Camera, pullOf, wrap } from "../../../src/lab/scene/ray";

/** At the front of the actuator, on its axis, upright, looking back along it. */
const FRONT: Camera = {
  fov: 30,
  aspect: 1,
  // Columns: right, up and back of the camera in three.js' axes, then its place.
  matrixWorld: { elements: [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, -10, 1] },
};

describe("the angle under the pointer", () => {
  it("is that of the link: down is zero, and q grows towards +y", () => {
    expect(angleSeen(FRONT, 0, -0.5)).toBeCloseTo(0, 9);
    expect(angleSeen(FRONT, 0.5, 0)).toBeCloseTo(Math.PI / 2, 9);
    expect(angleSeen(FRONT, -0.5, -0.5)).toBeCloseTo(-Math.PI / 4, 9);
  });

  it("is none where the sight goes away from the link's plane", () => {
    const behind = [...FRONT.matrixWorld.elements];
    behind[14] = 10;
    expect(angleSeen({ ...FRONT, matrixWorld: { elements: behind } }, 0, 0)).toBeNull();
  });
});

describe("the spring of the pointer", () => {
  it("pulls towards it from where the link was taken, at most with 1.5 N·m", () => {
    expect(pullOf(0.5, 0.5, 0)).toBe(0);
    expect(pullOf(0.9, 0.5, 0.2)).toBeCloseTo(0.5, 9);
    expect(pullOf(3, 0, 0)).toBe(1.5);
    expect(pullOf(-3, 0, 0)).toBe(-1.5);
  });

  it("takes the short way round", () => {
    expect(wrap(2 * Math.PI + 0.1)).toBeCloseTo(0.1, 9);
    expect(pullOf(-3.1, 3.1, 0)).toBeGreaterThan(0);
  });
});
