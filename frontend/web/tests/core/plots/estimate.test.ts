import "../../browserless";
import { describe, expect, it } from "vitest";
import { bandsOf } from "../../../src/core/plots/bands";
import type { Points } from "../../../src/core/plots/decimation";
import { describeEstimate, describeKnowledge } from "../../../src/core/plots/estimate";
import { composeContent, noteOfStiffness, tracesOf } from "../../../src/core/plots/traces";
import type { LaneSegments } from "../../../src/core/state/lanes";

const NAN = Number.NaN;
const sample = (estimate: number, deviation: number, misfit: number) => (channel: string) =>
  ({
    stiffness_estimate_nm_per_rad: estimate,
    stiffness_deviation_nm_per_rad: deviation,
    spring_misfit: misfit,
  })[channel] ?? NAN;

describe("the stiffness estimate", () => {
  it.each([
    [41.234, 0.2, "41.2 ± 0.4", "Stiffness known to ±1.0 %"],
    [60, 6, "60 ± 12", "Stiffness known to ±20 %"],
    [-5, -0.01, "-5.00 ± 0.02", "Stiffness known to ±0.4 %"],
    [15, 1.54, "not known yet", "Stiffness not known yet: apply a load"],
    [15, NAN, "not known yet", "Stiffness not known yet: apply a load"],
  ])("of %d with deviation %d is %s", (estimate, deviation, text, sentence) => {
    const read = sample(estimate, deviation, 1);
    expect(describeEstimate(read)).toBe(text);
    expect(describeKnowledge(read)).toBe(sentence);
  });

  it("is missing for another spring shape, and has no text while the estimator is off", () => {
    expect(describeEstimate(sample(NAN, NAN, 2))).toBe("model does not fit: no estimate");
    expect(describeEstimate(sample(NAN, NAN, NAN))).toBe("");
    expect(describeEstimate(() => NAN)).toBe("");
    expect(describeKnowledge(() => NAN)).toBe("");
  });
});

describe("the plot of the stiffness", () => {
  const channels = ["stiffness_nm_per_rad", "stiffness_estimate_nm_per_rad"] as const;
  const segment = (number: number, name: string) => [
    { number, name, lineStyle: number, hasEstimate: true, from: 0, to: Number.POSITIVE_INFINITY },
  ];
  const trace = (cast: LaneSegments, isBench = false) =>
    tracesOf(composeContent(channels, cast, isBench), new Set(channels), cast.length);
  const entries = (cast: LaneSegments, isBench = false) =>
    trace(cast, isBench)
      .filter(({ follows }) => follows === undefined)
      .map(({ label }) => label);
  const one = [segment(1, "NDOBC")];
  const two = [...one, segment(2, "FL")];

  it("names the stiffness for what it is", () => {
    expect(entries(one)).toEqual(["σ̂", "true stiffness σ"]);
    expect(entries(one, true)).toEqual(["σ̂", "nominal stiffness"]);
    expect(noteOfStiffness(trace(one), false)).toBeUndefined();
    expect(entries(two)).toEqual(["NDOBC σ̂", "NDOBC", "FL"]);
    expect(noteOfStiffness(trace(two), false)).toBe("true σ");
    expect(noteOfStiffness(trace(two, true), true)).toBe("bench: nominal σ");
    const alone = trace(two, true).filter(({ channel }) => channel !== channels[1]);
    expect(noteOfStiffness(alone, true)).toBeUndefined();
  });

  it("has a band around the estimate, hidden with it, and interrupted by its gaps", () => {
    const [estimate, , upper, lower] = trace(one);
    expect(upper).toMatchObject({ follows: estimate?.key, fillsTo: lower?.key });
    expect(lower).toMatchObject({ channel: "stiffness_lower_nm_per_rad", follows: estimate?.key });
    const points = (...y: number[]): Points => ({
      x: Float64Array.from(y, (value, at) => (Number.isNaN(value) ? NAN : at)),
      y: Float64Array.from(y),
      count: y.length,
    });
    const curves = [upper, lower].map((curve, index) => ({
      trace: curve as NonNullable<typeof curve>,
      points: index === 0 ? points(3, 4, NAN, 5) : points(1, 2, NAN, 3),
    }));
    const { outline } = bandsOf(curves)[0] as { outline: Points };
    expect([...outline.y.slice(0, outline.count)]).toEqual([3, 4, 2, 1, NAN, 5, 3, NAN]);
    expect([...outline.x.slice(0, outline.count)]).toEqual([0, 1, 1, 0, NAN, 3, 3, NAN]);
    expect(bandsOf(curves.slice(0, 1))).toEqual([]);
  });
});
