import { describe, expect, it, vi } from "vitest";
import type { RunVerdict } from "../../../src/core/api/types";
import type { OverlayCurve } from "../../../src/runs/list/overlaycurves";
import { stubBrowser } from "../../browser";

stubBrowser();
vi.stubGlobal("document", { baseURI: "http://lab/", documentElement: { dataset: {} } });
vi.stubGlobal("location", { search: "" });
const {
  buildRequest,
  listBands,
  listAssessments: listJudged,
} = await import("../../../src/runs/list/verdict");
const { listKnown } = await import("../../../src/runs/list/drawnverdict");

const POSITION = "position_error_rad";
const curve = (run: string, zeroS: number) =>
  ({ key: `${run}.lane1`, run, laneId: "lane1", zeroS }) as OverlayCurve;
const band = (times: number[]) => ({
  time_s: times,
  low: times.map(() => -0.1),
  high: times.map((_, index) => (index === 1 ? null : 0.1)),
});
const verdict = (times: number[], change: object = {}) =>
  ({
    channels: [
      {
        ...{ lane: "lane1", channel: POSITION, unit: "rad", held: false, worst_s: 7.25 },
        ...{ value: Math.PI, low: null, high: Math.PI / 2, excess: 1 },
        ...{ outside: [[7, 7.5]], outside_s: 0.4 },
      },
    ],
    bands: { [POSITION]: { lane1: band(times) } },
    ...change,
  }) as unknown as RunVerdict;

describe("a verdict in an overlay", () => {
  const curves = [curve("a", 2), curve("b", 5), curve("c", 4)];
  const judged = [
    { run: "b", reference: "a", verdict: verdict([1, 2, 3]) },
    { run: "c", reference: "a", verdict: verdict([1, 2, 3, 4], { channels: [] }) },
  ];

  it("sends in the units of the record the values entered in displayed units", () => {
    const bounds = { absolute: 180, relativePercent: 5, timeS: 0.01 };
    const stiffness = { absolute: 2, relativePercent: 0, timeS: 0 };
    const wanted = buildRequest(
      "a",
      {
        position_error_rad: bounds,
        stiffness_error_nm_per_rad: stiffness,
      },
      "start",
    );
    expect(wanted.tolerances?.[POSITION]?.absolute).toBeCloseTo(Math.PI);
    expect(wanted.tolerances?.[POSITION]).toMatchObject({ relative: 0.05, time_s: 0.01 });
    expect(wanted.tolerances?.stiffness_error_nm_per_rad?.absolute).toBe(2);
    expect(wanted).toMatchObject({ other: "a", rest: null, align: "start" });
  });

  it("is shown in the time of the axis, whose 0 differs between the runs", () => {
    const [one, ...rest] = listJudged(curves, judged);
    expect(rest).toEqual([]);
    expect(one).toMatchObject({ isWithin: false, worstS: 2.25, outside: [[2, 2.5]], low: null });
    expect(one?.value).toBeCloseTo(180);
    expect(one?.high).toBeCloseTo(90);
  });

  it("shows the longest of bands that differ in length only", () => {
    const [shown, ...rest] = listBands(curves, judged, POSITION);
    expect(rest).toEqual([]);
    expect(shown?.time).toEqual([-1, 0, 1, 2]);
    expect(shown?.high[0]).toBeCloseTo((0.1 * 180) / Math.PI);
    expect(listBands(curves, judged, "stiffness_error_nm_per_rad")).toEqual([]);
  });

  it("has a gap where the band is not known", () => {
    expect(listKnown({ time: [0, 1, 2, 3], low: [0, 0, 0, 0], high: [1, null, 1, 1] })).toEqual([
      [0, 1],
      [2, 4],
    ]);
  });
});
