import { beforeEach, expect, it, vi } from "vitest";
import type { LawRow } from "../../../src/core/api/types";
import { quantityOfSchema } from "../../../src/core/schema";

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

it("a number of a law is in SI, with a slider if it has both bounds", async () => {
  const { schemaOfLaw } = await import("../../../src/lab/panels/law");
  const row = { ...RATE, default: 2, low: 0, high: 3 };
  const { properties = {} } = schemaOfLaw(
    law("lqi", {
      parameters: [
        { ...row, low: 1, high: 150 },
        { ...row, name: "angle", unit: "rad", low: null },
        { ...row, name: "gains", kind: "numbers", meaning: "Gains of the link", default: [1, 2] },
        { ...row, name: "long", meaning: "Rate of the link's own motion" },
        { ...row, name: "is_on", kind: "flag", default: true },
      ],
    }),
  );
  expect(Object.keys(properties)).toEqual(["rate", "angle", "gains", "long"]);
  expect(properties.rate).toMatchObject({ title: "Rate", minimum: 1, maximum: 150 });
  expect(properties.rate?.slider).toEqual({ min: 1, max: 150, logarithmic: true });
  expect([properties.rate?.about, properties.angle?.slider]).toEqual([undefined, undefined]);
  expect(quantityOfSchema(properties.angle ?? {})).toMatchObject({ unit: "rad", max: 3 });
  const items = properties.gains?.prefixItems?.map(({ title }) => title);
  expect(items).toEqual(["Gains of the link 1", "Gains of the link 2"]);
  const about = "Rate of the link's own motion";
  expect(properties.long).toMatchObject({ symbol: "ω", title: about, about });
  expect(properties.long?.slider?.logarithmic).toBe(false);
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
