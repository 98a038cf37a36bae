import { describe, expect, it } from "vitest";
import {
  axesOf,
  ellipseOf,
  pathOf,
  placeLinks,
  placeTip,
  pullOf,
  reachOf,
} from "../../src/core/armgeometry";

const LENGTHS = [0.3, 0.2];
type Pair = readonly [number, number];
const POSES: readonly Pair[] = [
  [0.3, 0.9],
  [-0.8, -1.7],
  [2.9, 0.4],
];
const STEP = 1e-6;

/** J by differences, row by row. */
function jacobian([q1, q2]: Pair): [number, number, number, number] {
  const tip = placeTip(LENGTHS, [q1, q2]);
  const first = placeTip(LENGTHS, [q1 + STEP, q2]);
  const second = placeTip(LENGTHS, [q1, q2 + STEP]);
  const slope = (one: number, from: number) => (one - from) / STEP;
  return [
    slope(first.x, tip.x),
    slope(second.x, tip.x),
    slope(first.y, tip.y),
    slope(second.y, tip.y),
  ];
}

describe("the tip of an arm", () => {
  it("hangs straight down at zero and turns to the right with positive angles", () => {
    expect(placeTip(LENGTHS, [0, 0])).toEqual({ x: 0, y: -0.5 });
    const links = placeLinks(LENGTHS, [Math.PI / 2, 0]);
    expect(links.map(({ x }) => x)).toEqual([0.3, 0.5]);
    expect(links[1]?.y).toBeCloseTo(0, 12);
  });

  it.each(POSES)("moves under a force as K predicts, at %f, %f", (q1, q2) => {
    const sigma = [80, 20] as const;
    const found = ellipseOf(LENGTHS, [q1, q2], sigma);
    if (found === null) throw new Error("no ellipse");
    const [a, b, c, d] = jacobian([q1, q2]);
    for (const [k, angle] of [
      [found.greatest, found.angle],
      [found.least, found.angle + Math.PI / 2],
    ] as const) {
      const force = { x: Math.cos(angle), y: Math.sin(angle) };
      // Deflections Jᵀ f / σ of the joints move the tip by J times them: f / k along each axis.
      const dq1 = (a * force.x + c * force.y) / sigma[0];
      const dq2 = (b * force.x + d * force.y) / sigma[1];
      expect(a * dq1 + b * dq2).toBeCloseTo(force.x / k, 7);
      expect(c * dq1 + d * dq2).toBeCloseTo(force.y / k, 7);
    }
    expect(found.greatest).toBeGreaterThan(found.least);
  });

  it("yields with a third joint by its compliance", () => {
    const three = ellipseOf([0.3, 0.2, 0.1], [0.3, 0.9, 0], [80, 20, 1e12]);
    const soft = ellipseOf([0.3, 0.2, 0.1], [0.3, 0.9, 0.4], [80, 20, 10]);
    const stiff = ellipseOf([0.3, 0.2, 0.1], [0.3, 0.9, 0.4], [80, 20, 40]);
    // A rigid joint 3 without an angle lengthens link 2.
    const longer = ellipseOf([0.3, 0.3], [0.3, 0.9], [80, 20]);
    expect(three?.greatest).toBeCloseTo(longer?.greatest ?? 0, 6);
    expect(three?.angle).toBeCloseTo(longer?.angle ?? 0, 9);
    expect(soft?.least).toBeLessThan(stiff?.least ?? 0);
  });

  it("has no ellipse where the arm is straight, folded or unknown", () => {
    for (const q2 of [0, Math.PI, Number.NaN]) {
      expect(ellipseOf(LENGTHS, [0.4, q2], [80, 80])).toBeNull();
    }
    expect(ellipseOf(LENGTHS, [0.4, 1], [Number.NaN, 80])).toBeNull();
    expect(ellipseOf([0.3], [0.4], [80])).toBeNull();
  });
});

describe("the drawn ellipse", () => {
  it("grows with the square root of the stiffness up to half of the reach", () => {
    const axes = (sigma: number) => {
      const found = ellipseOf(LENGTHS, [0.4, 1.2], [sigma, sigma]);
      return found === null ? [] : axesOf(LENGTHS, found, 150);
    };
    const [soft, stiff] = [axes(10), axes(40)];
    expect(stiff[0]).toBeCloseTo(2 * (soft[0] as number), 12);
    expect(stiff[1]).toBeCloseTo(2 * (soft[1] as number), 12);
    expect(axes(1e6)[0]).toBe(0.5 * reachOf(LENGTHS));
  });
});

describe("a push", () => {
  it("is a spring between tip and pointer, with a largest force", () => {
    const tip = { x: 0.1, y: -0.3 };
    expect(pullOf(LENGTHS, tip, { x: 0.2, y: -0.3 }, 10).x).toBeCloseTo(4, 12);
    const far = pullOf(LENGTHS, tip, { x: 0.1, y: 3 }, 10);
    expect(far.x).toBeCloseTo(0, 12);
    expect(far.y).toBeCloseTo(10, 12);
  });
});

it("interrupts a path where samples are missing", () => {
  const points = [{ x: 0, y: 0 }, { x: 1, y: 2 }, null, { x: 2, y: 2 }];
  expect(pathOf(points, 10)).toBe("M0.0 0.0L10.0 -20.0M20.0 -20.0");
});
