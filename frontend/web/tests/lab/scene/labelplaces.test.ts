import { describe, expect, it } from "vitest";
import {
  type Box,
  LabelPlaces,
  type LabelRequest,
  lineEnd,
  type PlacedLabel,
} from "../../../src/lab/scene/labelplaces";
import {
  findOnPicture,
  isOccluded,
  type SceneObject,
  type SeeingCamera,
} from "../../../src/lab/scene/projection";

/** The area of the labels above the tools, for the window sizes that the lab supports. */
const FIELDS: Box[] = [
  { left: 4, top: 4, width: 362, height: 214 },
  { left: 4, top: 4, width: 360, height: 352 },
  { left: 4, top: 4, width: 420, height: 510 },
];
const WIDTHS = [15, 17, 17, 18, 22, 24, 37, 37, 42, 46, 50, 52, 98, 110, 24, 24, 24, 60, 15, 30];

/** Pseudo-random numbers 0 … 1, the same in every run. */
function* count(seed: number): Generator<number> {
  for (let state = seed; ; ) {
    state = (1103515245 * state + 12345) % 2147483648;
    yield state / 2147483648;
  }
}

/** Parts in the center of the area, many of them nearly coincident. */
function spread(field: Box, seed: number, count_: number): LabelRequest[] {
  const numbers = count(seed);
  const next = () => numbers.next().value as number;
  return WIDTHS.slice(0, count_).map((width, index) => {
    const reach = index % 3 === 0 ? 0.05 : 0.7;
    const x = field.left + field.width * (0.5 + reach * (next() - 0.5));
    const y = field.top + field.height * (0.5 + reach * (next() - 0.5));
    return { key: String(index), x, y, width, height: 16 };
  });
}

function gap(one: Box, other: Box): number {
  const across = Math.max(one.left - other.left - other.width, other.left - one.left - one.width);
  const down = Math.max(one.top - other.top - other.height, other.top - one.top - one.height);
  return Math.max(across, down);
}

function expectClear(placed: readonly PlacedLabel[], field: Box): void {
  for (const [index, one] of placed.entries()) {
    expect(one.left).toBeGreaterThanOrEqual(field.left);
    expect(one.top).toBeGreaterThanOrEqual(field.top);
    expect(one.left + one.width).toBeLessThanOrEqual(field.left + field.width);
    expect(one.top + one.height).toBeLessThanOrEqual(field.top + field.height);
    for (const other of placed.slice(index + 1)) expect(gap(one, other)).toBeGreaterThan(0);
  }
}

const lengthOf = (one: PlacedLabel): number => {
  const end = lineEnd(one);
  return Math.hypot(end.x - one.x, end.y - one.y);
};

describe("labels on a picture", () => {
  const cases = FIELDS.flatMap((field) => [1, 2, 3, 4, 5, 6].map((seed) => ({ field, seed })));

  it.each(cases)(
    "lie in the field, clear of each other, all of them: $field $seed",
    ({ field, seed }) => {
      const placed = new LabelPlaces().place(spread(field, seed, 20), field);
      expect(placed).toHaveLength(20);
      expectClear(placed, field);
      const lengths = placed.map(lengthOf).sort((one, other) => one - other);
      expect(lengths[10]).toBeLessThan(20);
    },
  );

  it.each(FIELDS)("do not overlap while their parts move, and keep a good place", (field) => {
    const places = new LabelPlaces();
    const first = spread(field, 7, 12);
    let before = places.place(first, field);
    let kept = 0;
    for (let step = 1; step <= 40; step++) {
      const moved = first.map((one, index) => ({
        ...one,
        x: one.x + 40 * Math.sin(step / 8 + index),
        y: one.y + 30 * Math.cos(step / 8),
      }));
      const placed = places.place(moved, field);
      expectClear(placed, field);
      for (const one of placed) {
        const last = before.find(({ key }) => key === one.key);
        if (last && Math.abs(one.left - one.x - (last.left - last.x)) < 1e-9) kept++;
      }
      before = placed;
    }
    expect(kept / (40 * 12)).toBeGreaterThan(0.8);
  });

  it("are next to their part if there is space", () => {
    const [field] = FIELDS as [Box];
    const wanted = { key: "q", x: 150, y: 100, width: 17, height: 16 };
    const [placed] = new LabelPlaces().place([wanted], field);
    expect(lengthOf(placed as PlacedLabel)).toBeLessThan(8);
  });

  it("are hidden if the part is outside or there is no space", () => {
    const [field] = FIELDS as [Box];
    const outside = { key: "far", x: 500, y: 100, width: 17, height: 16 };
    expect(new LabelPlaces().place([outside], field)).toEqual([]);
    const inside = { ...outside, key: "near", x: 100 };
    expect(new LabelPlaces().place([inside], field, [field])).toEqual([]);
    expect(new LabelPlaces().place([inside], field)).toHaveLength(1);
  });
});

describe("the visibility of a part", () => {
  const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  const matrixAt = (z: number) => {
    const elements = [...identity];
    elements[14] = z;
    const back = [...identity];
    back[14] = -z;
    return { elements, clone: () => ({ elements, clone: never, invert: () => inverseOf(back) }) };
  };
  const never = () => {
    throw new Error("not asked for");
  };
  const inverseOf = (elements: number[]) => ({ elements, clone: never });
  const EYE: SeeingCamera = {
    fov: 90,
    aspect: 2,
    matrixWorld: { elements: identity },
    matrixWorldInverse: { elements: identity },
  };
  /** A triangle across the line of sight at a depth, about the axis of the picture. */
  const sheet = (z: number, transparent = false): SceneObject => ({
    matrixWorld: matrixAt(z),
    isMesh: true,
    geometry: {
      attributes: { position: { array: [-1, -1, 0, 1, -1, 0, 0, 2, 0] } },
      index: null,
      boundingSphere: { center: { x: 0, y: 0, z: 0 }, radius: 2 },
      computeBoundingSphere: never,
    },
    material: { transparent },
    traverseVisible: never,
  });
  const partsOf = (...parts: SceneObject[]): SceneObject => ({
    matrixWorld: matrixAt(0),
    traverseVisible: (visit) => parts.forEach(visit),
  });

  it("matches the picture of the camera", () => {
    expect(findOnPicture(EYE, [0, 0, -4])).toEqual({ x: 0.5, y: 0.5 });
    const aside = findOnPicture(EYE, [4, 2, -4]);
    expect([aside?.x, aside?.y]).toEqual([expect.closeTo(0.75, 9), expect.closeTo(0.25, 9)]);
    expect(findOnPicture(EYE, [0, 0, 1])).toBeNull();
  });

  it("is blocked by a solid in front of it only", () => {
    expect(isOccluded(EYE, [0, 0, -4], partsOf(sheet(-2)))).toBe(true);
    expect(isOccluded(EYE, [0, 0, -4], partsOf(sheet(-6)))).toBe(false);
    expect(isOccluded(EYE, [3.9, 0, -4], partsOf(sheet(-2)))).toBe(false);
  });

  it("is not blocked by an outline or by the part's own surface", () => {
    expect(isOccluded(EYE, [0, 0, -4], partsOf(sheet(-2, true)))).toBe(false);
    expect(isOccluded(EYE, [0, 0, -4], partsOf(sheet(-3.95)))).toBe(false);
  });
});
