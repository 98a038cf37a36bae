import { describe, expect, it } from "vitest";
import type { Segment } from "../../../src/core/state/lanes";
import { stubBrowser } from "../../browser";

stubBrowser();
const { composeOfJoint, lanesOfJoint } = await import("../../../src/core/plots/joints");

const segment = (number: number, name: string): Segment => ({
  number,
  name,
  lineStyle: number,
  hasEstimate: true,
  from: 0,
  to: Number.POSITIVE_INFINITY,
});
const CAST = [
  [segment(1, "Joint 1 NDOBC")],
  [segment(2, "Joint 2 NDOBC")],
  [segment(3, "Joint 1 FL")],
  [segment(4, "Joint 2 FL")],
];

describe("the plots of a joint of an arm", () => {
  it("have its lanes with the names of their controllers", () => {
    const channels = ["position_rad", "position_reference_rad"] as const;
    const { groups, common } = composeOfJoint(channels, CAST, 2, 2);
    const traces = groups.flatMap((group) => group.traces);
    expect(traces.map(({ lane, label }) => [lane, label])).toEqual([
      [2, "NDOBC"],
      [4, "FL"],
    ]);
    expect(common.map(({ lane }) => lane)).toEqual([2]);
  });

  it("have one lane without a comparison", () => {
    const { groups } = composeOfJoint(["torque1_nm", "torque2_nm"], CAST.slice(0, 2), 2, 2);
    expect(groups.flatMap(({ traces }) => traces.map(({ lane }) => lane))).toEqual([2, 2]);
  });

  it("have all lanes for a single joint", () => {
    expect(lanesOfJoint(4, null, 1)).toEqual([1, 2, 3, 4]);
    expect(lanesOfJoint(4, 1, 2)).toEqual([1, 3]);
  });
});
