import { describe, expect, it } from "vitest";
import { formatPercents } from "../../../src/core/quantities";
import { packColour } from "../../../src/evaluation/studies/dots";
import {
  countCells,
  cutBins,
  distribute,
  findBin,
  findNearest,
  markBrushed,
  scaleOf,
  spreadNames,
} from "../../../src/evaluation/studies/points";
import { unpackRows } from "../../../src/evaluation/studies/rows";
import {
  chooseAxes,
  factorOf,
  readBrush,
  shownUnit,
  writeBrush,
} from "../../../src/evaluation/studies/studyview";

const numbers = (...values: number[]) => Float64Array.from(values);
const all = (count: number) => new Uint8Array(count).fill(1);

function pack(header: object, columns: number[][]): ArrayBuffer {
  let text = JSON.stringify(header);
  while ((text.length + 4) % 8 !== 0) text += " ";
  const head = new TextEncoder().encode(text);
  const packed = new ArrayBuffer(4 + head.length + 8 * columns.flat().length);
  new DataView(packed).setUint32(0, head.length, true);
  new Uint8Array(packed, 4).set(head);
  new Float64Array(packed, 4 + head.length).set(columns.flat());
  return packed;
}

describe("received rows", () => {
  it("are columns of numbers, or of names with their labels", () => {
    const columns = [{ name: "row" }, { name: "law", labels: ["ndobc", "fl"] }];
    const rows = unpackRows(
      pack({ rows: 3, total: 9, columns }, [
        [4, 5, 6],
        [0, 1, 0],
      ]),
    );
    expect([rows.count, rows.total]).toEqual([3, 9]);
    expect([...(rows.columns.get("row")?.values ?? [])]).toEqual([4, 5, 6]);
    expect(rows.columns.get("law")).toMatchObject({ labels: ["ndobc", "fl"] });
    expect([...(rows.columns.get("law")?.values ?? [])]).toEqual([0, 1, 0]);
  });
});

describe("the brush", () => {
  it("contains the points inside and on its edges, and all points if there is no brush", () => {
    const [x, y] = [numbers(0, 1, 2, 3), numbers(5, 6, Number.NaN, 8)];
    expect([...markBrushed(x, y, { x: [1, 3], y: [6, 8] })]).toEqual([0, 1, 0, 1]);
    expect([...markBrushed(x, y, null)]).toEqual([1, 1, 1, 1]);
  });
  it("is written to the address and read back, and an invalid one is ignored", () => {
    const brush = { plane: "t", x: [1.5, 2], y: [-0.25, 1e-5] } as const;
    expect(readBrush(writeBrush(brush))).toEqual(brush);
    for (const wrong of ["", "s", "s:1,2,3", "q:1,2,3,4", "s:1,2,x,4", "s:1,2,3,4,5"]) {
      expect(readBrush(wrong)).toBeNull();
    }
  });
});

describe("a dot", () => {
  it("is found nearest to the pointer on the screen, among the displayed ones", () => {
    const [x, y] = [numbers(0, 1, 1.1), numbers(0, 1, 1)];
    const place = (at: number, height: number) => [100 * at, 100 * height] as const;
    expect(findNearest(x, y, all(3), place, [104, 100], 14)).toBe(1);
    expect(findNearest(x, y, Uint8Array.of(1, 0, 1), place, [104, 100], 14)).toBe(2);
    expect(findNearest(x, y, all(3), place, [50, 50], 14)).toBeNull();
  });
  it("of a name is inside its place, which is the same in every drawing", () => {
    const spread = spreadNames(numbers(0, 0, 1, 1));
    expect([...spread].map(Math.round).map(Math.abs)).toEqual([0, 0, 1, 1]);
    expect(spreadNames(numbers(0, 0, 1, 1))).toEqual(spread);
  });
  it("has the colour of its law in the order of the canvas", () => {
    expect(packColour("#0072b2", 255)).toBe(0xffb27200);
  });
});

describe("scales", () => {
  it("contain all values, and are logarithmic only if all are positive", () => {
    const { span, isLog } = scaleOf(numbers(0.01, 100, Number.NaN), true);
    expect(isLog).toBe(true);
    expect(span[0]).toBeLessThan(0.01);
    expect(span[1]).toBeGreaterThan(100);
    expect(scaleOf(numbers(0, 100), true).isLog).toBe(false);
    expect(scaleOf(numbers(Number.NaN), true).span).toEqual([0, 1]);
    const one = scaleOf(numbers(5, 5), false).span;
    expect(one[0]).toBeLessThan(5);
    expect(one[1]).toBeGreaterThan(5);
  });
});

describe("the map", () => {
  it("has one cell per grid value, and bins of equal width for sampled values", () => {
    const grid = numbers(...Array.from({ length: 9 }, (_, at) => at % 3));
    expect(cutBins(grid, false)).toEqual([-0.5, 0.5, 1.5, 2.5]);
    const ratios = numbers(...Array.from({ length: 9 }, (_, at) => 10 ** (at % 3)));
    expect(cutBins(ratios, true).map((edge) => Number(edge.toFixed(2)))).toEqual([
      0.32, 3.16, 31.62, 316.23,
    ]);
    const drawn = numbers(0, 1, 2, 4);
    expect(cutBins(drawn, false, 4)).toEqual([0, 1, 2, 3, 4]);
  });
  it("counts a value on an edge in the bin above it, and the greatest in the last bin", () => {
    expect([-1, 0, 1, 3.9, 4, 5, Number.NaN].map((at) => findBin([0, 1, 2, 4], at))).toEqual([
      -1, 0, 1, 2, 2, -1, -1,
    ]);
  });
  it("counts the displayed runs and the successful ones among them", () => {
    const edges = [
      [0, 1, 2],
      [0, 1],
    ] as const;
    const [x, y] = [numbers(0.5, 0.6, 1.5, 1.6), numbers(0.5, 0.5, 0.5, 0.5)];
    expect(countCells(x, y, numbers(1, 0, 1, 1), Uint8Array.of(1, 1, 1, 0), edges)).toEqual([
      { column: 0, line: 0, runs: 2, good: 1 },
      { column: 1, line: 0, runs: 1, good: 1 },
    ]);
  });
});

describe("the summary of many runs", () => {
  it("counts a run that ended in a fault as worse than any value", () => {
    const values = numbers(1, 2, 3, 0.5, Number.NaN);
    const ended = Uint8Array.of(0, 0, 0, 1, 0);
    expect(distribute(values, ended, all(5), [0.9, 1, 2.5, 9])).toEqual([0, 20, 40, 60]);
    expect(distribute(values, ended, Uint8Array.of(1, 0, 0, 1, 0), [9])).toEqual([50]);
  });
});

describe("a share in percent", () => {
  it("is 100 or 0 only if it is exactly that", () => {
    expect(formatPercents([1, 0.9999961585, 1])).toEqual(["100.0000", "99.9996", "100.0000"]);
    expect(formatPercents([0, 0, 3.8414e-6])).toEqual(["0.0000", "0.0000", "0.0004"]);
    expect(formatPercents([0.999999, 0.9999943351, 0.9999998235])).toEqual([
      "99.99990",
      "99.99943",
      "99.99998",
    ]);
    expect(formatPercents([0.8, 0.4901625, 0.9433178])).toEqual(["80.0", "49.0", "94.3"]);
  });
  it("has no interval of zero width", () => {
    const [, low, high] = formatPercents([0.5, 0.49996901, 0.50003099]);
    expect([low, high]).toEqual(["49.997", "50.003"]);
  });
});

describe("the first plot of a study", () => {
  const column = (name: string, role: "row" | "varied" | "outcome" | "metric") => ({
    name,
    label: name,
    role,
    unit: "",
    is_text: false,
    is_log: false,
  });
  it("has the first two settings as axes, and the error over the first", () => {
    const metrics = [column("peak", "metric"), column("rms_position_error_rad", "metric")];
    const varied = [column("load", "varied"), column("inertia", "varied")];
    expect(chooseAxes([column("row", "row"), ...varied, ...metrics])).toEqual({
      sx: "load",
      sy: "inertia",
      tx: "load",
      ty: "rms_position_error_rad",
      metric: "rms_position_error_rad",
    });
    expect(chooseAxes(metrics)).toMatchObject({ sx: "law", sy: "rms_position_error_rad" });
  });
  it("is in degrees", () => {
    expect(factorOf("rad")).toBeCloseTo(57.29578, 5);
    expect([shownUnit("rad·s"), shownUnit("N·m/rad"), factorOf("N·m/rad")]).toEqual([
      "°·s",
      "N·m/rad",
      1,
    ]);
  });
});
