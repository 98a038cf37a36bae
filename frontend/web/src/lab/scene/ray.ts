/** Intersection of a ray through the picture with the actuator. */

/** A camera as in three.js: column-major world matrix, vertical field of view in degrees. */
export interface Camera {
  fov: number;
  aspect: number;
  matrixWorld: { elements: readonly number[] };
}

type Vector = readonly [number, number, number];

/**
 * The plane in which the link rotates: position of its front on the axis, in the scene's lengths.
 */
const LINK_PLANE = 0.85;

/** In three.js y points up, and the axis of the scene is reversed. */
const toScene = ([x, y, z]: Vector): Vector => [-z, -x, y];

/** Position of a camera in the scene's coordinates. */
export const placeOf = ({ matrixWorld: { elements } }: Camera): Vector =>
  toScene([elements[12] as number, elements[13] as number, elements[14] as number]);

function turn(elements: readonly number[], [x, y, z]: Vector): Vector {
  const row = (index: number) =>
    (elements[index] as number) * x +
    (elements[index + 4] as number) * y +
    (elements[index + 8] as number) * z;
  return [row(0), row(1), row(2)];
}

/**
 * The angle, in the convention of q, at which the ray through a point of the picture intersects the
 * plane of the link. right, up: −1 … 1 from edge to edge. Null without an intersection.
 */
export function angleSeen(camera: Camera, right: number, up: number): number | null {
  const { elements } = camera.matrixWorld;
  const reach = Math.tan((camera.fov * Math.PI) / 360);
  const sight = toScene(turn(elements, [right * camera.aspect * reach, up * reach, -1]));
  const from = placeOf(camera);
  const distance = (LINK_PLANE - from[0]) / sight[0];
  if (!Number.isFinite(distance) || distance <= 0) return null;
  const y = from[1] + distance * sight[1];
  const z = from[2] + distance * sight[2];
  return Math.atan2(y, -z);
}

/** An angle wrapped to −π … π. */
export const wrap = (angle: number): number => Math.atan2(Math.sin(angle), Math.cos(angle));

const SPRING_NM_PER_RAD = 2.5;
const MAX_NM = 1.5;

/** Torque of the spring between the pointer and the grabbed point of the link, N·m. */
export function pullOf(pointer: number, link: number, taken: number): number {
  const torque = SPRING_NM_PER_RAD * wrap(pointer - link - taken);
  return Math.max(-MAX_NM, Math.min(MAX_NM, torque));
}
