import "../../browserless";
import { describe, expect, test } from "vitest";
import type { Results, Row } from "../../../src/core/api/ranking";
import { COLUMNS, type Column, sortRows } from "../../../src/evaluation/ranking/columns";

const { readPoint, scaleLog } = await import("../../../src/evaluation/ranking/pareto");
const { splitSource } = await import("../../../src/evaluation/ranking/ranking");
const { readPlace, writePlace } = await import("../../../src/runs/list/place");

const PEAK = "peak_position_error_rad";
const familyOf = (held: number, position: number | null) => ({
  trials: 100,
  held,
  success: held / 100,
  success_low: held / 100 - 0.1,
  success_high: held / 100 + 0.1,
  metrics: {
    rms_position_error_rad: Array(9).fill(position),
    rms_stiffness_error_nm_per_rad: Array(9).fill(0.5),
    rms_torque1_nm: Array(9).fill(3),
  },
});
const rowOf = (
  key: string,
  held: number,
  mass: number | null,
  position: number | null = 0.01,
): Row =>
  ({
    key,
    law: key,
    families: { A: familyOf(held, position), B: familyOf(held, position) },
    scenarios: [
      {
        scenario: "mass",
        runs: 16,
        faults: mass === null ? 9 : 0,
        worst: "mass.negative.3",
        median: { [PEAK]: mass },
        worst_values: { [PEAK]: null },
      },
    ],
  }) as unknown as Row;
const columnOf = (key: string): Column => COLUMNS.find((one) => one.key === key) as Column;
const RESULTS = {
  rows: [rowOf("a", 90, 0.3), rowOf("b", 70, null), rowOf("c", 60, 0.1)],
  ranks: [
    { key: "a", rank: 1, p_value: 1e-9 },
    { key: "b", rank: 1, p_value: 0.25 },
    { key: "c", rank: 3, p_value: null },
  ],
} as unknown as Results;

describe("the ranking's table", () => {
  test("a row without a number is last in both sorting directions", () => {
    const order = (key: string, isDown: boolean) =>
      sortRows(RESULTS, key, isDown).map(({ key: row }) => row);
    expect(order("mass", false)).toEqual(["c", "a", "b"]);
    expect(order("mass", true)).toEqual(["a", "c", "b"]);
    expect(order("rank", false)).toEqual(["a", "b", "c"]);
    expect(order("familyB", false)).toEqual(["c", "b", "a"]);
  });

  test("a success rate has its interval, and a small p its bound", () => {
    const [first, second, third] = RESULTS.rows as [Row, Row, Row];
    expect(columnOf("familyA").write(first, RESULTS)).toBe("90.0 (80.0–100.0)");
    expect(columnOf("p").write(first, RESULTS)).toBe("< 0.001");
    expect(columnOf("p").write(second, RESULTS)).toBe("0.25");
    expect(columnOf("p").write(third, RESULTS)).toBe("–");
  });

  test("a fixed scenario shows median and worst in degrees with its faults, and its worst run", () => {
    const column = columnOf("mass");
    expect(column.write(rowOf("d", 1, Math.PI / 180), RESULTS)).toBe("1.00 / fault");
    expect(column.write(RESULTS.rows[1] as Row, RESULTS)).toBe("fault / fault, 9 of 16");
    expect(column.scenarioOf?.(RESULTS.rows[0] as Row)).toBe("mass.negative.3");
  });
});

describe("the plot of errors", () => {
  test("a point has the medians of family A, and is omitted if a median is a fault", () => {
    expect(readPoint(rowOf("a", 1, 1, Math.PI / 180))).toMatchObject({
      position: 1,
      stiffness: 0.5,
      torque: 3,
    });
    expect(readPoint(rowOf("a", 1, 1, null))).toBeNull();
  });

  test("equal ratios have equal lengths, and powers of ten are marked", () => {
    const { place, ticks } = scaleLog([0.05, 5]);
    expect(place(0.5) - place(0.05)).toBeCloseTo(place(5) - place(0.5));
    expect(ticks.map((tick) => tick.toPrecision(1))).toEqual(["0.1", "1"]);
  });
});

test("the ranking has an address", () => {
  expect(readPlace("?ranking=all&session=x")).toEqual({ kind: "ranking" });
  expect(writePlace({ kind: "ranking" }, "?runs=all")).toBe("?ranking=all");
  expect(writePlace({ kind: "lab" }, "?ranking=all")).toBe("");
});

test("the DOI of a citation is a link", () => {
  const said = 'D. Q. Mayne, "Constrained model predictive control", Automatica 36(6), 2000, ';
  const doi = "10.1016/S0005-1098(99)00214-9";
  expect(splitSource(`${said}doi:${doi}`)).toEqual({ said, doi });
  for (const source of ["Eq 24", 'P. Tomei, "A simple PD controller", 1991', ""]) {
    expect(splitSource(source)).toEqual({ said: source, doi: "" });
  }
});
