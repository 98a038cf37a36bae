/** Position and stiffness of the tip of an arm: as `svsa_scene/tip.py`. x to the right, y up. */

export interface Point {
  x: number;
  y: number;
}

/** Lengths of the links from joint 1 on, m. */
export type Lengths = readonly number[];

/** The lengths of the links of an arm, m. */
export const lengthsOf = ({ chain }: { chain: readonly { length_m: number }[] }): Lengths =>
  chain.map(({ length_m: length }) => length);

const sum = (values: readonly number[]): number =>
  values.reduce((total, value) => total + value, 0);

/** Largest distance of the tip from joint 1, m. */
export const reachOf = (lengths: Lengths): number => sum(lengths);

/** The joints after joint 1, and the tip, at these angles of the joints (rad), m. */
export function placeLinks(lengths: Lengths, q: readonly number[]): Point[] {
  let [x, y, p] = [0, 0, 0];
  return lengths.map((length, index) => {
    p += q[index] as number;
    x += length * Math.sin(p);
    y -= length * Math.cos(p);
    return { x, y };
  });
}

/** The tip at these angles of the joints (rad), m. */
export const placeTip = (lengths: Lengths, q: readonly number[]): Point =>
  placeLinks(lengths, q).at(-1) as Point;

/** Each two elements. */
function pairsOf<T>(values: readonly T[]): [T, T][] {
  return values.flatMap((first, index) =>
    values.slice(index + 1).map((second): [T, T] => [first, second]),
  );
}

const sumOfPairs = (lengths: Lengths): number => sum(pairsOf(lengths).map(([a, b]) => a * b));

/** Force for a unit displacement in the stiffest direction, and across it, N/m. */
export interface StiffnessEllipse {
  greatest: number;
  least: number;
  /** Direction of the greatest from horizontal, counterclockwise, rad. */
  angle: number;
}

/** A smaller sine between two links counts as straight or folded, where the stiffness is infinite. */
const STRAIGHT = 1e-6;

/**
 * The principal axes of K = (J diag(1/σ) Jᵀ)⁻¹, without the part of the gravity; null for a straight
 * or folded arm, for one link, and for unknown values.
 */
export function ellipseOf(
  lengths: Lengths,
  q: readonly number[],
  stiffness: readonly number[],
): StiffnessEllipse | null {
  const joints = [{ x: 0, y: 0 }, ...placeLinks(lengths, q)];
  const tip = joints.pop() as Point;
  // A joint moves the tip at right angles to the line from the joint.
  const columns = joints.map(({ x, y }, index) => ({
    x: y - tip.y,
    y: tip.x - x,
    sigma: stiffness[index] as number,
  }));
  const areas = pairsOf(columns).map(([a, b]) => ({
    area: a.x * b.y - a.y * b.x,
    product: a.sigma * b.sigma,
  }));
  const straight = STRAIGHT * sumOfPairs(lengths);
  if (!(Math.hypot(...areas.map(({ area }) => area)) > straight)) return null;
  const determinant = sum(areas.map(({ area, product }) => area ** 2 / product));
  const kxx = sum(columns.map(({ y, sigma }) => (y * y) / sigma)) / determinant;
  const kyy = sum(columns.map(({ x, sigma }) => (x * x) / sigma)) / determinant;
  const kxy = -sum(columns.map(({ x, y, sigma }) => (x * y) / sigma)) / determinant;
  const mean = (kxx + kyy) / 2;
  const radius = Math.hypot((kxx - kyy) / 2, kxy);
  if (!Number.isFinite(mean)) return null;
  return {
    greatest: mean + radius,
    least: Math.max(mean - radius, 0),
    angle: 0.5 * Math.atan2(2 * kxy, kxx - kyy),
  };
}

/** Half axis of the greatest stiffness of the joints over the products of each two lengths, and the
 * longest one drawn.
 */
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
  const full = (FULL_AXIS * reach) / Math.sqrt(most / sumOfPairs(lengths));
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
