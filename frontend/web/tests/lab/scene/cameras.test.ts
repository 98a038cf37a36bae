import { describe, expect, it } from "vitest";
import { addressOf, CAMERA_NAMES, placeCamera } from "../../../src/lab/scene/cameras";

describe("the camera from the side", () => {
  /** Half of what it sees along the axis, at the motor's near side (y = 0.48). */
  const halfSeen = (aspect: number) =>
    (placeCamera("side", aspect).position[1] - 0.48) * Math.tan(Math.PI / 12) * aspect;

  it.each([0.6, 0.86, 0.93, 1.42, 2])("has the motor and the load whole, aspect %f", (aspect) => {
    const middle = placeCamera("side", aspect).look_at[0];
    expect(middle - halfSeen(aspect)).toBeLessThan(-3.75);
    expect(middle + halfSeen(aspect)).toBeGreaterThan(1.7);
  });

  it("is no farther away than it has to be", () => {
    expect(placeCamera("side", 2)).toEqual(placeCamera("side", 1.2));
    expect(halfSeen(0.6)).toBeCloseTo(halfSeen(0.8), 0);
  });
});

describe("the first camera", () => {
  it("is in viser's address, as far away as the picture is narrow", () => {
    const { position } = placeCamera("whole", 0.45);
    const asked = new URLSearchParams(addressOf(placeCamera("whole", 0.45)));
    expect(asked.get("initialCameraPosition")?.split(",").map(Number)).toEqual([...position]);
    const near = placeCamera("whole", 2).position;
    expect(Math.hypot(...position)).toBeGreaterThan(1.8 * Math.hypot(...near));
  });

  it.each(CAMERA_NAMES)("%s has an angle that the address tells in rad", (name) => {
    const place = placeCamera(name, 1);
    const fov = Number(new URLSearchParams(addressOf(place)).get("initialCameraFov"));
    expect(fov).toBeCloseTo((place.fov_deg * Math.PI) / 180, 9);
  });
});
