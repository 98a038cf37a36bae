import { describe, expect, it } from "vitest";
import { columnsOf, writeCsv } from "../../../src/core/plots/csv";
import {
  decimate,
  emptyPoints,
  extentOf,
  samplesPerBucket,
} from "../../../src/core/plots/decimation";
import { measureBetween } from "../../../src/core/plots/statistics";
import { SampleRing, type Segment } from "../../../src/core/stream/ring";

const ALONE = [
  [
    {
      number: 1,
      name: "NDOBC",
      lineStyle: 0,
      hasEstimate: true,
      from: 0,
      to: Number.POSITIVE_INFINITY,
    },
  ],
];

function ringOf(values: readonly number[], channel = "position_error_rad"): SampleRing {
  const ring = new SampleRing(1000, [channel], [1]);
  const header = { run: 1, firstTick: 0, stride: 10, missed: 0, lanes: [1] };
  ring.append({ ...header, count: values.length, values: new Float32Array(values) }, 0.001);
  return ring;
}

const all = (ring: SampleRing, first = 0): Segment =>
  ring.segment("position_error_rad", 1, first, ring.length) as Segment;

function decimated(values: readonly number[], perBucket: number, first = 0) {
  const points = emptyPoints();
  decimate(all(ringOf(values), first), perBucket, 1, points);
  const { x, y, count } = points;
  return Array.from({ length: count }, (_, index) => [x[index], y[index]]);
}

const GAP = [Number.NaN, Number.NaN];

describe("decimation", () => {
  it("keeps every sample if there is space", () => {
    expect(decimated([1, 5, 2], 1).map(([, y]) => y)).toEqual([1, 5, 2]);
    expect(samplesPerBucket(400, 480)).toBe(1);
    expect(samplesPerBucket(12_001, 480)).toBe(26);
  });

  it("keeps the minimum and maximum of each bucket in the order of time", () => {
    const points = decimated([0, 9, 1, 2, 5, 4, -7, 3], 4);
    expect(points).toEqual([
      [0, 0],
      [0.01, 9],
      [0.04, 5],
      [0.06, -7],
    ]);
  });

  it("uses the same buckets from any start", () => {
    const values = Array.from({ length: 40 }, (_, index) => Math.sin(index * 1.7));
    const whole = decimated(values, 8);
    expect(decimated(values, 8, 5).slice(-8)).toEqual(whole.slice(-8));
  });

  it("leaves a gap at missing numbers", () => {
    const none = Number.NaN;
    expect(decimated([1, none, none, none, none, none, 4, 4, 5], 3)).toEqual([
      [0, 1],
      GAP,
      [0.06, 4],
      [0.08, 5],
    ]);
    expect(decimated([none, none, none], 3)).toEqual([GAP]);
  });

  it("ignores missing numbers in the extent", () => {
    const points = { x: new Float64Array(3), y: new Float64Array([Number.NaN, -4, 3]), count: 3 };
    expect(extentOf([points])).toEqual([-4, 3]);
    expect(extentOf([{ ...points, count: 1 }])).toEqual([null, null]);
    expect(extentOf([])).toEqual([null, null]);
  });
});

describe("a measurement between two cursors", () => {
  const ring = ringOf([3, -4, Number.NaN, 12, 100]);
  const measure = (a: number, b: number, factor = 1) =>
    measureBetween(ring, "position_error_rad", 1, [a, b], factor);

  it("uses the samples without interpolation", () => {
    expect(measure(0, 3)).toEqual({
      ...{ a: 3, b: 12, delta: 9, min: -4, max: 12 },
      rms: Math.sqrt((9 + 16 + 144) / 3),
      missingS: expect.closeTo(0.01),
    });
  });

  it("does not depend on the order of the cursors, except for the sign of the difference", () => {
    expect(measure(3, 0)).toMatchObject({ delta: -9, min: -4, max: 12 });
  });

  it("is in the displayed unit", () => {
    expect(measure(0, 1, 2)).toMatchObject({ a: 6, b: -8, delta: -14, min: -8, max: 6 });
  });

  it("is NaN without samples", () => {
    expect(measure(2, 2)).toEqual({
      ...{ a: Number.NaN, b: Number.NaN, delta: Number.NaN },
      ...{ min: Number.NaN, max: Number.NaN, rms: Number.NaN, missingS: 0 },
    });
  });
});

/** 100 Hz: six samples of 1, a gap of 2 s, then six samples of 2. */
function ringWithGap(): SampleRing {
  const ring = new SampleRing(1000, ["position_error_rad"], [1]);
  const header = { run: 1, stride: 10, count: 6, lanes: [1] };
  const six = (value: number) => new Float32Array(6).fill(value);
  ring.append({ ...header, firstTick: 0, missed: 0, values: six(1) }, 0.001);
  ring.append({ ...header, firstTick: 2060, missed: 200, values: six(2) }, 0.001);
  return ring;
}

describe("a gap of 2 s", () => {
  it("interrupts the curve, also if many samples share a bucket", () => {
    for (const perBucket of [1, 4, 50]) {
      const points = emptyPoints();
      decimate(all(ringWithGap()), perBucket, 1, points);
      const ys = [...points.y.subarray(0, points.count)];
      const gap = ys.findIndex(Number.isNaN);
      expect(ys.slice(0, gap)).toEqual(ys.slice(0, gap).fill(1));
      expect(gap).toBeGreaterThan(0);
      const after = ys.slice(gap).filter((y) => !Number.isNaN(y));
      expect(after.length).toBeGreaterThan(0);
      expect(after).toEqual(after.fill(2));
    }
  });

  it("is reported with a measurement across it", () => {
    const ring = ringWithGap();
    const across = measureBetween(ring, "position_error_rad", 1, [0, ring.length - 1]);
    expect(across).toMatchObject({ a: 1, b: 2, delta: 1, min: 1, max: 2 });
    expect(across.missingS).toBeCloseTo(2, 9);
    expect(measureBetween(ring, "position_error_rad", 1, [0, 5]).missingS).toBe(0);
  });

  it("has a row without values at each end in CSV", () => {
    const csv = writeCsv(
      ringWithGap(),
      { from: 0.05, to: 2.06 },
      columnsOf(["position_error_rad"], ALONE, { from: 0, to: 3 }),
    );
    expect(csv.split("\r\n").slice(1, -1)).toEqual(["0.05,1", "0.06,", "2.05,", "2.06,2"]);
  });
});

describe("CSV", () => {
  it("has one column per controller, empty while another one was in control", () => {
    const [ndobc] = ALONE[0] as [(typeof ALONE)[0][0]];
    const switched = [
      [
        { ...ndobc, to: 0.02 },
        { ...ndobc, number: 2, name: "FL", from: 0.02 },
      ],
    ];
    const span = { from: 0, to: 1 };
    const columns = columnsOf(["position_error_rad"], switched, span);
    expect(
      writeCsv(ringOf([1, 2, 3, 4]), span, columns)
        .split("\r\n")
        .slice(0, -1),
    ).toEqual([
      '"time_s [s]","NDOBC.position_error_rad [rad]","FL.position_error_rad [rad]"',
      "0,1,",
      "0.01,2,",
      "0.02,,3",
      "0.03,,4",
    ]);
    expect(columnsOf(["position_error_rad"], switched, { from: 0.05, to: 1 })).toHaveLength(1);
  });

  it("contains the window only, with units in the names and empty cells for missing numbers", () => {
    const csv = writeCsv(
      ringOf([0.5, Number.NaN, 0.1, 7]),
      { from: 0, to: 0.02 },
      columnsOf(["position_error_rad"], ALONE, { from: 0, to: 3 }),
    );
    expect(csv.split("\r\n")).toEqual([
      '"time_s [s]","NDOBC.position_error_rad [rad]"',
      "0,0.5",
      "0.01,",
      "0.02,0.100000001",
      "",
    ]);
  });
});
