import { afterEach, describe, expect, it } from "vitest";
import type { SessionState } from "../../../src/core/api/types";
import { stubBrowser } from "../../browser";

stubBrowser();
const { areJointsDifferent, jointChoice, settingsOf, shownJoints } = await import(
  "../../../src/core/state/arm"
);
const { comparisonLanes } = await import("../../../src/core/state/lanes");
const { nameArms } = await import("../../../src/core/state/joints");
const { isWeight, nextWeight } = await import("../../../src/core/state/plant");
const { session } = await import("../../../src/core/state/session");

const lane = (number: number, name: string) => ({ lane: number, id: number, name, segments: [] });
const joint = (law: string, sigma: number) => ({
  law,
  stiffness: { kind: "constant", stiffness_nm_per_rad: sigma },
  comparisons: [{ law: "fl" }],
});
const STATE = {
  configuration: {
    ...joint("ndobc", 80),
    arm: { other_joints: [{ ...joint("pd", 80), arm: null }] },
  },
  actuator: { name: "svsa" },
  other_actuators: [{ name: "qbmove" }],
  bench: null,
  loads: [],
  lanes: ["Joint 1 NDOBC", "Joint 2 PD", "Joint 1 FL", "Joint 2 FL"].map((name, index) =>
    lane(index + 1, name),
  ),
} as unknown as SessionState;

afterEach(() => {
  jointChoice.value = "all";
  session.value = null;
});

describe("the settings of an arm", () => {
  it("are those of the selected joint, with its actuator", () => {
    expect(settingsOf(STATE).configuration.law).toBe("ndobc");
    jointChoice.value = "2";
    const { configuration, actuator } = settingsOf(STATE);
    expect([configuration.law, actuator.name]).toEqual(["pd", "qbmove"]);
    expect(configuration.arm).toBe(STATE.configuration.arm);
  });

  it("may differ between the joints, part by part", () => {
    expect(areJointsDifferent(STATE, ["stiffness"])).toBe(false);
    expect(areJointsDifferent(STATE, ["law", "gains"])).toBe(true);
    jointChoice.value = "1";
    expect(areJointsDifferent(STATE, ["law"])).toBe(false);
  });

  it("select the joint whose plots are shown", () => {
    expect(shownJoints.value).toBeNull();
    session.value = STATE;
    expect(shownJoints.value).toEqual([1, 2]);
    jointChoice.value = "2";
    expect(shownJoints.value).toEqual([2]);
  });
});

it("compares with the lanes of the second arm", () => {
  expect(comparisonLanes(STATE).map(({ lane, id }) => [lane, id])).toEqual([[2, 3]]);
});

it("adds its mass at the tip", () => {
  expect(nextWeight(STATE)).toEqual({ kind: "tip_mass", mass_kg: 0.1 });
  const row = { load: { kind: "tip_mass", mass_kg: 1 } } as SessionState["loads"][number];
  expect(isWeight(STATE, row)).toBe(true);
});

it("the name of an arm includes both joints if their controllers differ", () => {
  expect(
    nameArms(
      STATE.lanes.map(({ name }) => name),
      2,
    ),
  ).toEqual(["NDOBC, PD", "FL"]);
});
