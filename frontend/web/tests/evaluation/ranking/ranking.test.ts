import "../../browserless";
import { beforeAll, describe, expect, test } from "vitest";
import type { Row, SweepOutcome } from "../../../src/core/api/ranking";
import {
  barOf,
  COLUMNS,
  type Column,
  formatValue,
  isBest,
  sortRows,
  versionsOf,
} from "../../../src/evaluation/ranking/columns";

let pointOf: typeof import("../../../src/evaluation/ranking/radar").pointOf;
let bearsUpTo: typeof import("../../../src/evaluation/ranking/radar").bearsUpTo;
let bearsFromTo: typeof import("../../../src/evaluation/ranking/radar").bearsFromTo;
let choose: typeof import("../../../src/evaluation/ranking/ranking").choose;
let chosen: typeof import("../../../src/evaluation/ranking/ranking").chosen;
let splitSource: typeof import("../../../src/evaluation/ranking/ranking").splitSource;
let readPlace: typeof import("../../../src/runs/list/place").readPlace;
let writePlace: typeof import("../../../src/runs/list/place").writePlace;

beforeAll(async () => {
  ({ pointOf, bearsUpTo, bearsFromTo } = await import("../../../src/evaluation/ranking/radar"));
  ({ choose, chosen, splitSource } = await import("../../../src/evaluation/ranking/ranking"));
  ({ readPlace, writePlace } = await import("../../../src/runs/list/place"));
});

const rowOf = (law: string, score: number, mass: number | null, step = 2): Row =>
  ({
    law,
    score,
    mass_rms_deg: mass,
    largest_link_step_nm: step,
    outcomes: [{ scenario: "mass", fault: mass === null ? "lever_end" : null }],
    load_removal_worst: "load_removal_12_10",
    trials_fails: 1,
    trials_failed: ["trial_7"],
  }) as unknown as Row;
const columnOf = (key: string): Column => COLUMNS.find((one) => one.key === key) as Column;
const sweepOf = (values: number[], passed: number[]) => ({ values, passed }) as SweepOutcome;
const ROWS = [rowOf("a", 0.5, 0.3), rowOf("b", 0.7, null), rowOf("c", 0.1, 3.0)];

describe("the ranking's table", () => {
  test("a law without a number comes last, whichever way a column is sorted", () => {
    const order = (key: string, isDown: boolean) =>
      sortRows(ROWS, key, isDown).map(({ law }) => law);
    expect(order("mass", false)).toEqual(["a", "c", "b"]);
    expect(order("mass", true)).toEqual(["c", "a", "b"]);
    expect(order("score", true)).toEqual(["b", "a", "c"]);
  });

  test("the best is the least error and the greatest score, and a fault is never it", () => {
    const best = (key: string) =>
      ROWS.filter((row) => isBest(columnOf(key), row, ROWS)).map(({ law }) => law);
    expect(best("mass")).toEqual(["a"]);
    expect(best("score")).toEqual(["b"]);
  });

  test("a decade of error is as long wherever it lies; a count is a share of what there can be", () => {
    const rows = [0.01, 0.1, 1].map((mass) => rowOf("", 0, mass));
    const bars = [0.01, 0.1, 1].map((mass) => barOf(columnOf("mass"), mass, rows));
    expect(bars[2]).toBeCloseTo(1);
    expect((bars[2] ?? 0) - (bars[1] ?? 0)).toBeCloseTo((bars[1] ?? 0) - (bars[0] ?? 0));
    expect(barOf(columnOf("loadRemovals"), 12, rows)).toBe(0.25);
  });

  test("every version of the lab that measured a row is told once", () => {
    const rows = ["0.1.0", "0.2.0", "0.1.0"].map((version) => ({ ...ROWS[0], version }) as Row);
    expect(versionsOf(rows)).toEqual(["0.1.0", "0.2.0"]);
  });

  test("the best does not read as one that is half as good", () => {
    const [best, other] = [5.4e-5, 7.7e-5].map((value) => formatValue(columnOf("ideal"), value));
    expect([best, other]).toEqual(["0.000054", "0.000077"]);
    expect(formatValue(columnOf("ideal"), 0.00128)).toBe("0.0013");
    expect(formatValue(columnOf("loadRemovals"), 16)).toBe("16");
  });

  test("a number opens its run, and a count the first that failed", () => {
    expect(columnOf("mass").scenarioOf(ROWS[1] as Row)).toBe("mass");
    expect(columnOf("mass").faultOf(ROWS[1] as Row)).toBe("lever_end");
    expect(columnOf("rest").scenarioOf(ROWS[0] as Row)).toBe("load_removal_12_10");
    expect(columnOf("fails").scenarioOf(ROWS[0] as Row)).toBe("trial_7");
    expect(columnOf("step").scenarioOf(ROWS[0] as Row)).toBe("link_step_2.5");
    expect(columnOf("step").scenarioOf(rowOf("d", 1, 1, 15))).toBe("link_step_15");
    expect(columnOf("score").scenarioOf(ROWS[0] as Row)).toBeNull();
  });
});

describe("the six sweeps", () => {
  test("the first axis points up, and a share of nothing is the middle", () => {
    const [x, y] = pointOf(0, 6, 1);
    expect(x).toBeCloseTo(0);
    expect(y).toBeLessThan(0);
    expect(pointOf(3, 6, 0).map(Math.abs)).toEqual([0, 0]);
  });

  test("a law bears a thing up to the last value before one at which not every run held", () => {
    expect(bearsUpTo(sweepOf([1, 2, 4], [1, 0.5, 1]))).toBe(1);
    expect(bearsUpTo(sweepOf([1, 2, 4], [1, 1, 1]))).toBe(4);
    expect(bearsUpTo(sweepOf([1, 2], [0, 1]))).toBeNull();
  });

  test("a model may be wrong about the nominal one, not beyond a gap", () => {
    const values = [0.25, 0.5, 1, 2, 4];
    expect(bearsFromTo(sweepOf(values, [1, 0, 1, 1, 0.5]))).toEqual([1, 2]);
    expect(bearsFromTo(sweepOf(values, [1, 1, 0, 1, 1]))).toBeNull();
  });
});

describe("what is looked at", () => {
  test("a law that is pressed is told of; pressed again it goes, and four are the most", () => {
    chosen.value = [];
    for (const law of ["a", "b", "c", "d", "e"]) choose(law);
    expect(chosen.value).toEqual(["b", "c", "d", "e"]);
    choose("c");
    expect(chosen.value).toEqual(["b", "d", "e", "c"]);
    choose("c");
    expect(chosen.value).toEqual(["b", "d", "e"]);
  });

  test("the ranking has an address", () => {
    expect(readPlace("?ranking=all&session=x")).toEqual({ kind: "ranking" });
    expect(writePlace({ kind: "ranking" }, "?runs=all")).toBe("?ranking=all");
    expect(writePlace({ kind: "lab" }, "?ranking=all")).toBe("");
  });
});

test("a DOI at the end of a citation is what is linked", () => {
  const said = 'D. Q. Mayne, "Constrained model predictive control", Automatica 36(6), 2000, ';
  const doi = "10.1016/S0005-1098(99)00214-9";
  expect(splitSource(`${said}doi:${doi}`)).toEqual({ said, doi });
});

test("an equation, and a citation whose DOI nobody looked up, are not linked", () => {
  for (const source of ["Eq 24", 'P. Tomei, "A simple PD controller", 1991', ""]) {
    expect(splitSource(source)).toEqual({ said: source, doi: "" });
  }
});
