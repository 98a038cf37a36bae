import { beforeEach, expect, it, vi } from "vitest";
import type { LawRow } from "../../../src/core/api/types";

const law = (name: string, changes: Partial<LawRow> = {}): LawRow => ({
  ...{ name, title: name.toUpperCase(), line_style: 0, summary: "", equation: "u=0", source: "" },
  ...{ notes: "", estimate: "none", takes_gains: false, parameters: [], problem: null },
  ...changes,
});
const RATE = { name: "rate", symbol: "ω", meaning: "Rate", unit: "rad/s", kind: "number" } as const;

beforeEach(() => {
  vi.resetModules();
  vi.stubGlobal("window", new EventTarget());
  vi.stubGlobal("document", { baseURI: "http://lab/" });
  vi.stubGlobal("location", { search: "" });
});

it("the default comparison law is the first other usable one", async () => {
  const {
    laws,
    defaultComparisonLaw: otherLaw,
    titleOf,
    usableLaws,
  } = await import("../../../src/core/state/laws");
  expect(otherLaw("ndobc")).toBeUndefined();
  laws.value = [law("broken", { problem: "no" }), law("a"), law("b"), law("c")];
  expect(usableLaws.value.map(({ name }) => name)).toEqual(["a", "b", "c"]);
  expect([otherLaw("a"), otherLaw("b"), otherLaw("gone")]).toEqual(["b", "a", "a"]);
  expect([titleOf("b"), titleOf("gone")]).toEqual(["B", "gone"]);
});

it("a parameter has a slider if it has both bounds", async () => {
  const { changedAt, rangeOf } = await import("../../../src/lab/panels/law");
  const { hasLongMeaning: isWordy } = await import("../../../src/core/state/laws");
  const row = { ...RATE, default: 2 };
  expect(rangeOf({ ...row, low: 1, high: 150 })).toEqual({
    range: { min: 1, max: 150, logarithmic: true },
  });
  expect(rangeOf({ ...row, low: 0, high: 3 }).range?.logarithmic).toBe(false);
  expect(rangeOf({ ...row, low: null, high: 3 })).toEqual({});
  expect([isWordy({ ...row, low: 1, high: 2 })]).toEqual([false]);
  expect(isWordy({ ...row, meaning: "Rate of the link's own motion", low: 1, high: 2 })).toBe(true);
  expect(changedAt(2, null, 3)).toBe(3);
  expect(changedAt([1, 2, 3], 1, 5)).toEqual([1, 5, 3]);
});

it("Enter selects the law with that exact name, or else the first match", async () => {
  const { findLaws, pickLaw } = await import("../../../src/core/state/laws");
  const listed = [
    law("adrc", { summary: "observers" }),
    law("spared", { estimate: "own", summary: "of deflection, fl" }),
    law("ndobc", { estimate: "observer", summary: "an observer" }),
    law("fl"),
  ];
  const take = (sought: string) => pickLaw(findLaws(listed, sought), sought)?.name;
  expect([take("observer"), take(" fl"), take("refl"), take("defl")]).toEqual([
    ...["ndobc", "fl", undefined, "spared"],
  ]);
});

it("a rejected parameter is named as its field, in a lane too if all laws name it the same", async () => {
  const { laws } = await import("../../../src/core/state/laws");
  const { explainViolation } = await import("../../../src/core/state/refusal");
  const message = (name: string) =>
    explainViolation({
      ...{ name, value: 5000, unit: "rad/s", bound: "at most 100 rad/s", limits: { le: 100 } },
      ...{ finding: "", message: "as the server says" },
    });
  const out = (name: string) =>
    `${name}: 5000 rad/s is out of range (at most 100 rad/s). The value is unchanged.`;
  const rate = { ...RATE, default: 2, low: 1, high: 100 };
  const wordy = {
    ...rate,
    name: "velocity_rad_per_s",
    symbol: "e_v",
    meaning: "Error of the velocity",
  };
  const clash = { ...rate, name: "pole", symbol: "", meaning: "Pole of the link" };
  laws.value = [
    law("lqi", { parameters: [rate, wordy, clash] }),
    law("pd", { parameters: [rate, { ...clash, meaning: "Pole of the motor" }] }),
  ];
  expect(message("lqi.velocity_rad_per_s")).toBe(out("e_v"));
  expect(message("comparisons[0].parameters.velocity_rad_per_s")).toBe(out("e_v"));
  expect(message("parameters.rate")).toBe(out("Rate"));
  expect(message("pd.rate[1]")).toBe(out("Rate 2"));
  expect(message("parameters.pole")).toBe("as the server says");
  expect(message("lqi.gone")).toBe("as the server says");
});

it("an active law is listed with its own equation, and those of the paper once", async () => {
  const { equationsOf } = await import("../../../src/core/equations/equation");
  const printed = equationsOf("controller", []).length;
  const found = equationsOf("controller", [law("ndobc"), law("motor_pd", { title: "PD" })]);
  expect(found).toHaveLength(printed + 1);
  expect(found[0]?.tex).toBe(String.raw`\text{PD:}\quad u=0`);
  expect(equationsOf("torque", [law("motor_pd")])).toEqual(equationsOf("torque", []));
});

it("filters of runs show the titles of laws, and the names of those not installed", async () => {
  const { laws } = await import("../../../src/core/state/laws");
  const { nameValue } = await import("../../../src/runs/list/words");
  expect(nameValue("law", "motor_pd")).toBe("motor_pd");
  laws.value = [law("fl_integral", { title: "FL + I" }), law("bad", { problem: "no" })];
  expect(["fl_integral", "motor_pd", "bad"].map((name) => nameValue("law", name))).toEqual([
    "FL + I",
    "motor_pd (not installed)",
    "bad (does not load)",
  ]);
  expect([nameValue("figure", "4a"), nameValue("tag", "fl"), nameValue("plant", "bench")]).toEqual([
    "Fig. 4A",
    "fl",
    "Bench",
  ]);
});
