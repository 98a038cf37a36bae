/** Position and stiffness of the tip of an arm: as `svsa_scene/tip.py`. x to the right, y up. */

export interface Point {
  x: number;
  y: number;
}

/** Lengths of the links, m. */
export interface Lengths {
  length1: number;
  length2: number;
}

/** Largest distance of the tip from joint 1, m. */
export const reachOf = ({ length1, length2 }: Lengths): number => length1 + length2;

/** Joint 2 and the tip at these angles (rad), m. */
export function placeLinks({ length1, length2 }: Lengths, q1: number, q2: number) {
  const elbow = { x: length1 * Math.sin(q1), y: -length1 * Math.cos(q1) };
  const p = q1 + q2;
  const tip = { x: elbow.x + length2 * Math.sin(p), y: elbow.y - length2 * Math.cos(p) };
  return { elbow, tip };
}

/** Force for a unit displacement in the stiffest direction, and across it, N/m. */
export interface StiffnessEllipse {
  greatest: number;
  least: number;
  /** Direction of the greatest from horizontal, counterclockwise, rad. */
  angle: number;
}

/** A smaller |sin q2| counts as straight or folded, where the stiffness is infinite. */
const STRAIGHT = 1e-6;

/**
 * The principal axes of K = J⁻ᵀ diag(σ1, σ2) J⁻¹, without the part of the gravity; null for a
 * straight or folded arm, and for unknown values.
 */
export function ellipseOf(
  { length1, length2 }: Lengths,
  [q1, q2]: readonly [number, number],
  stiffness: readonly [number, number],
): StiffnessEllipse | null {
  const determinant = length1 * length2 * Math.sin(q2);
  if (!(Math.abs(determinant) >= STRAIGHT * length1 * length2)) return null;
  const p = q1 + q2;
  const across = { x: length2 * Math.sin(p), y: -length2 * Math.cos(p) };
  const rows = [
    across,
    { x: -length1 * Math.sin(q1) - across.x, y: length1 * Math.cos(q1) - across.y },
  ] as const;
  let [kxx, kxy, kyy] = [0, 0, 0];
  rows.forEach(({ x, y }, index) => {
    const scale = (stiffness[index] as number) / determinant ** 2;
    kxx += scale * x * x;
    kxy += scale * x * y;
    kyy += scale * y * y;
  });
  const mean = (kxx + kyy) / 2;
  const radius = Math.hypot((kxx - kyy) / 2, kxy);
  if (!Number.isFinite(mean)) return null;
  return {
    greatest: mean + radius,
    least: Math.max(mean - radius, 0),
    angle: 0.5 * Math.atan2(2 * kxy, kxx - kyy),
  };
}

/** Half axis of the greatest stiffness of the joints over l1 l2, and the longest one drawn. */
const FULL_AXIS = 0.32;
const MOST_AXIS = 0.5;

/**
 * Half axes of the drawn ellipse, m: with the root of the stiffness, so that soft and stiff are both
 * seen. most: greatest stiffness of the joints' actuators, N·m/rad.
 */
export function axesOf(
  lengths: Lengths,
  { greatest, least }: StiffnessEllipse,
  most: number,
): [number, number] {
  const reach = reachOf(lengths);
  const full = (FULL_AXIS * reach) / Math.sqrt(most / (lengths.length1 * lengths.length2));
  const axis = (k: number) => Math.min(full * Math.sqrt(k), MOST_AXIS * reach);
  return [axis(greatest), axis(least)];
}

/** The virtual spring between the tip and the pointer: the full force at half the reach. */
export function pullOf(lengths: Lengths, tip: Point, pointer: Point, mostN: number): Point {
  const spring = mostN / (0.5 * reachOf(lengths));
  const [x, y] = [spring * (pointer.x - tip.x), spring * (pointer.y - tip.y)];
  const size = Math.hypot(x, y);
  const scale = size > mostN ? mostN / size : 1;
  return { x: scale * x, y: scale * y };
}

/** The end of a path that is drawn: points that differ visibly, as an SVG path in its units. */
export function pathOf(points: readonly (Point | null)[], scale: number): string {
  const parts: string[] = [];
  let isDown = false;
  for (const point of points) {
    if (point === null) {
      isDown = false;
      continue;
    }
    const at = `${(scale * point.x).toFixed(1)} ${(-scale * point.y).toFixed(1)}`;
    parts.push(`${isDown ? "L" : "M"}${at}`);
    isDown = true;
  }
  return parts.join("");
}
