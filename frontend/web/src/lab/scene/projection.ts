/** Projection of a point of viser's scene, and whether a solid part occludes it. */
import type { Camera } from "./ray";

type Numbers = ArrayLike<number>;

interface Matrix {
  elements: readonly number[];
  clone(): Matrix & { invert(): Matrix };
}

interface Geometry {
  attributes: { position?: { array: Numbers } };
  index: { array: Numbers } | null;
  boundingSphere: { center: Vector3; radius: number } | null;
  computeBoundingSphere(): void;
}

interface Vector3 {
  x: number;
  y: number;
  z: number;
}

/** The fields of three.js' objects that are read here. */
export interface SceneObject {
  matrixWorld: Matrix;
  isMesh?: boolean;
  geometry?: Geometry;
  material?: { transparent: boolean } | { transparent: boolean }[];
  traverseVisible(visit: (object: SceneObject) => void): void;
}

export interface SeeingCamera extends Camera {
  matrixWorldInverse: { elements: readonly number[] };
}

export type Vector = [number, number, number];

/** A part within this distance of a point, in scene units, belongs to the point. */
const OWN_PART = 0.1;

/** A point of a frame in the parent coordinates of the frame's matrix. */
export function transform({ elements: e }: { elements: readonly number[] }, point: Vector): Vector {
  const row = (index: number) =>
    (e[index] as number) * point[0] +
    (e[index + 4] as number) * point[1] +
    (e[index + 8] as number) * point[2] +
    (e[index + 12] as number);
  return [row(0), row(1), row(2)];
}

const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/**
 * Position of a point on the picture, 0 … 1 from its left and upper edge; null behind the camera.
 */
export function findOnPicture(
  camera: SeeingCamera,
  point: Vector,
): { x: number; y: number } | null {
  const [x, y, z] = transform(camera.matrixWorldInverse, point);
  if (z >= 0) return null;
  const reach = -z * Math.tan((camera.fov * Math.PI) / 360);
  return { x: 0.5 + x / (2 * reach * camera.aspect), y: 0.5 - y / (2 * reach) };
}

/** Ray parameter of the intersection with a triangle (Möller and Trumbore), or infinity. */
function intersectTriangle(from: Vector, way: Vector, a: Vector, b: Vector, c: Vector): number {
  const [ab, ac] = [minus(b, a), minus(c, a)];
  const p = cross(way, ac);
  const area = dot(ab, p);
  if (Math.abs(area) < 1e-12) return Number.POSITIVE_INFINITY;
  const t = minus(from, a);
  const u = dot(t, p) / area;
  const q = cross(t, ab);
  const v = dot(way, q) / area;
  if (u < 0 || v < 0 || u + v > 1) return Number.POSITIVE_INFINITY;
  const share = dot(ac, q) / area;
  return share > 0 ? share : Number.POSITIVE_INFINITY;
}

function missesSphere(from: Vector, way: Vector, geometry: Geometry): boolean {
  if (geometry.boundingSphere === null) geometry.computeBoundingSphere();
  const sphere = geometry.boundingSphere;
  if (sphere === null) return true;
  const { x, y, z } = sphere.center;
  const off = minus([x, y, z], from);
  const share = Math.max(0, Math.min(1, dot(off, way) / dot(way, way)));
  const nearest = minus(off, [share * way[0], share * way[1], share * way[2]]);
  return dot(nearest, nearest) > sphere.radius ** 2;
}

function intersectsMesh(from: Vector, way: Vector, most: number, geometry: Geometry): boolean {
  const points = geometry.attributes.position?.array;
  if (!points || missesSphere(from, way, geometry)) return false;
  const order = geometry.index?.array;
  const count = order?.length ?? points.length / 3;
  const corner = (index: number): Vector => {
    const at = 3 * ((order ? order[index] : index) as number);
    return [points[at] as number, points[at + 1] as number, points[at + 2] as number];
  };
  for (let index = 0; index + 2 < count; index += 3) {
    if (intersectTriangle(from, way, corner(index), corner(index + 1), corner(index + 2)) < most)
      return true;
  }
  return false;
}

const isSolid = ({ material: materials }: SceneObject): boolean =>
  ![materials].flat().some((material) => material?.transparent ?? true);

/** Whether a solid part occludes the point. */
export function isOccluded(camera: Camera, point: Vector, parts: SceneObject): boolean {
  const eye = transform(camera.matrixWorld, [0, 0, 0]);
  const sight = minus(point, eye);
  const most = 1 - OWN_PART / Math.hypot(...sight);
  let isFound = false;
  parts.traverseVisible((object) => {
    if (isFound || !object.isMesh || !object.geometry || !isSolid(object)) return;
    const inverse = object.matrixWorld.clone().invert();
    const from = transform(inverse, eye);
    isFound = intersectsMesh(from, minus(transform(inverse, point), from), most, object.geometry);
  });
  return isFound;
}
