import { describe, expect, it } from "vitest";
import { addressOf, cameraNames, placeCamera } from "../../../src/lab/scene/cameras";
import { angleSeen, type Camera, pullOf, wrap } from "../../../src/lab/scene/ray";

describe("the camera from the side", () => {
  /** Half of the visible height at the near side of the motor (y = 0.48). */
  const halfSeen = (aspect: number) =>
    (placeCamera("side", aspect).position[1] - 0.48) * Math.tan(Math.PI / 12) * aspect;

  it.each([0.6, 0.86, 0.93, 1.42, 2])("shows motor and load completely, aspect %f", (aspect) => {
    const middle = placeCamera("side", aspect).look_at[0];
    expect(middle - halfSeen(aspect)).toBeLessThan(-3.75);
    expect(middle + halfSeen(aspect)).toBeGreaterThan(1.7);
  });

  it("is as near as possible", () => {
    expect(placeCamera("side", 2)).toEqual(placeCamera("side", 1.2));
    expect(halfSeen(0.6)).toBeCloseTo(halfSeen(0.8), 0);
  });
});

describe("the initial camera", () => {
  it("is in the address of viser, farther away for a narrower picture", () => {
    const { position } = placeCamera("whole", 0.45);
    const asked = new URLSearchParams(addressOf(placeCamera("whole", 0.45)));
    expect(asked.get("initialCameraPosition")?.split(",").map(Number)).toEqual([...position]);
    const near = placeCamera("whole", 2).position;
    expect(Math.hypot(...position)).toBeGreaterThan(1.8 * Math.hypot(...near));
  });

  it.each(cameraNames("actuator"))("%s has an angle that the address contains in rad", (name) => {
    const place = placeCamera(name, 1);
    const fov = Number(new URLSearchParams(addressOf(place)).get("initialCameraFov"));
    expect(fov).toBeCloseTo((place.fov_deg * Math.PI) / 180, 9);
  });
});

/** At the front of the actuator, on its axis, upright, looking along the axis. */
const FRONT: Camera = {
  fov: 30,
  aspect: 1,
  // Columns: right, up and back of the camera in three.js' axes, then its position.
  matrixWorld: { elements: [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, -10, 1] },
};

describe("the angle under the pointer", () => {
  it("is that of the link: down is zero, and q grows towards +y", () => {
    expect(angleSeen(FRONT, 0, -0.5)).toBeCloseTo(0, 9);
    expect(angleSeen(FRONT, 0.5, 0)).toBeCloseTo(Math.PI / 2, 9);
    expect(angleSeen(FRONT, -0.5, -0.5)).toBeCloseTo(-Math.PI / 4, 9);
  });

  it("is unknown if the view ray points away from the plane of the link", () => {
    const behind = [...FRONT.matrixWorld.elements];
    behind[14] = 10;
    expect(angleSeen({ ...FRONT, matrixWorld: { elements: behind } }, 0, 0)).toBeNull();
  });
});

describe("the spring of the pointer", () => {
  it("pulls towards the pointer from the gripped point, at most with 1.5 N·m", () => {
    expect(pullOf(0.5, 0.5, 0)).toBe(0);
    expect(pullOf(0.9, 0.5, 0.2)).toBeCloseTo(0.5, 9);
    expect(pullOf(3, 0, 0)).toBe(1.5);
    expect(pullOf(-3, 0, 0)).toBe(-1.5);
  });

  it("uses the shorter direction of rotation", () => {
    expect(wrap(2 * Math.PI + 0.1)).toBeCloseTo(0.1, 9);
    expect(pullOf(-3.1, 3.1, 0)).toBeGreaterThan(0);
  });
});
