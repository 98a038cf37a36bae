import { describe, expect, it } from "vitest";
import {
  allAt,
  areTogether,
  bandwidthOf,
  countPlaces,
  MIN_RE,
  movePole,
  partnerOf,
  polesOf,
  stepPole,
  toRequest,
} from "../../../src/lab/design/poles";
import { describePole, describePoles, verdictOf } from "../../../src/lab/design/words";

const MIXED = [
  { re: -60, im: 0 },
  { re: -80, im: 0 },
  { re: -40, im: 30 },
  { re: -40, im: -30 },
];

describe("poles from the server", () => {
  it("moves numerical scatter around a multiple root onto the axis", () => {
    const dust = [
      { re: -60.01, im: 0.01 },
      { re: -60.01, im: -0.01 },
      { re: -59.99, im: 0.01 },
      { re: -59.99, im: -0.01 },
    ];
    expect(polesOf(dust)).toEqual(allAt(4, 60));
  });

  it("gives a pair exactly conjugate values", () => {
    const poles = polesOf([
      { re: -80, im: 0 },
      { re: -20, im: 0 },
      { re: -40, im: -30 },
      { re: -40, im: 30 },
    ]);
    expect(poles.slice(2)).toEqual([
      { re: -40, im: 30 },
      { re: -40, im: -30 },
    ]);
  });
});

describe("a verdict", () => {
  const found = (verdict: string, reasons: object[]) => ({ verdict, reasons }) as never;

  it("is good only if no limit is exceeded at any time", () => {
    expect(verdictOf(found("ok", []))).toBe("ok");
    expect(verdictOf(found("ok", [{ kind: "note", code: "saturation" }]))).toBe("note");
    expect(verdictOf(found("warn", [{ kind: "warn" }]))).toBe("warn");
  });
});

describe("moving a pole", () => {
  it("along the axis moves that pole only", () => {
    expect(movePole(allAt(4, 60), 3, { re: -90, im: 2 })).toEqual([
      ...allAt(3, 60),
      { re: -90, im: 0 },
    ]);
  });

  it("off the axis makes the nearest real pole its conjugate", () => {
    expect(movePole(MIXED, 0, { re: -70, im: 25 }).slice(0, 2)).toEqual([
      { re: -70, im: 25 },
      { re: -70, im: -25 },
    ]);
  });

  it("moves both poles of a pair, onto the axis too", () => {
    expect(movePole(MIXED, 3, { re: -30, im: -50 })[2]).toEqual({ re: -30, im: 50 });
    expect(movePole(MIXED, 2, { re: -45, im: 1 }).slice(2)).toEqual(allAt(2, 45));
  });

  it("keeps within the plane, and on the axis if there is no partner", () => {
    expect(movePole(MIXED, 0, { re: -900, im: 0 })[0]?.re).toBe(MIN_RE);
    const lonely = [{ re: -60, im: 0 }, ...MIXED.slice(2)];
    expect(partnerOf(lonely, 0)).toBe(-1);
    expect(movePole(lonely, 0, { re: -60, im: 50 })[0]).toEqual({ re: -60, im: 0 });
  });

  it("by keys leaves the axis at once and returns to it", () => {
    const off = stepPole(allAt(2, 40), 0, 0, 1);
    expect(off[0]?.im).toBeGreaterThan(0);
    expect(off[1]?.im).toBe(-(off[0]?.im as number));
    expect(stepPole(off, 0, 0, -1)).toEqual(allAt(2, 40));
  });
});

describe("text and numbers of poles", () => {
  it("use the mean magnitude as the bandwidth", () => {
    expect(bandwidthOf(allAt(4, 60))).toBeCloseTo(60, 9);
    expect(bandwidthOf(MIXED) ** 4).toBeCloseTo(60 * 80 * 2500, 3);
    expect(areTogether(allAt(4, 60))).toBe(true);
    expect(areTogether(MIXED)).toBe(false);
  });

  it("are written in the usual notation", () => {
    expect(describePoles(allAt(4, 60))).toBe("−60 ×4");
    expect(describePoles(MIXED)).toBe("−60, −80, −40 ± 30j");
    expect(describePole({ re: -40, im: -30 })).toBe("−40 − 30j");
    expect(countPlaces(allAt(4, 60))).toEqual([{ pole: { re: -60, im: 0 }, count: 4 }]);
  });

  it("are sent as a number for a real pole and as a pair for a complex one", () => {
    expect(MIXED.map(toRequest)).toEqual([-60, -80, [-40, 30], [-40, -30]]);
  });
});
