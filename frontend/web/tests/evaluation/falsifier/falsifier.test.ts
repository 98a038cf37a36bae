import "../../browserless";
import { beforeEach, describe, expect, test } from "vitest";
import api from "../../../../../docs/openapi.json";
import { resolveReferences } from "../../../requests";
import type { Adversary, LawTrace, Scenario, Search } from "../../../src/core/api/falsifications";
import type { Schema } from "../../../src/core/schema";
import {
  describeTerms,
  readModelError,
  spanOf,
  writeModelError,
} from "../../../src/evaluation/falsifier/definition";

const { rankLaws } = await import("../../../src/evaluation/falsifier/laws");
const {
  baselinesOf,
  selection: chosen,
  savedScenario,
  savedScenarios: kept,
  laws,
  scenario,
  search,
  searches,
} = await import("../../../src/evaluation/falsifier/falsifier");
const { place, readPlace, writePlace } = await import("../../../src/runs/list/place");
const { describeJob } = await import("../../../src/core/jobs/progress");

const TERMS: Adversary["terms"] = [
  { kind: "pulse", bodies: ["link"], torque_nm: 1.4, start_s: [2, 7], duration_s: [0.01, 2] },
  { kind: "step", bodies: ["link", "motor2"], torque_nm: 1, start_s: [0, 1] },
];
const perturbed = (path: string, low: number, high: number) =>
  ({ kind: "uniform", path, low, high, relative: true }) as Adversary["vary"][number];
const INERTIA = "actuator.link_inertia_kg_m2";
const SPRING = "actuator.spring_stiffness_n_per_m";

test("an error of the model is one number in percent, and other perturbations are kept", () => {
  const other = perturbed("gains.x", 0.5, 1.5);
  const off = [other, perturbed(INERTIA, 0.8, 1.2), perturbed(SPRING, 0.8, 1.2)];
  expect(readModelError(off)).toBe(20);
  expect(writeModelError(off, 20)).toEqual(off);
  expect(writeModelError(off, 0)).toEqual([other]);
  const uneven = [perturbed(INERTIA, 0.8, 1.2), perturbed(SPRING, 0.9, 1.1)];
  expect([readModelError(uneven), readModelError([other]), readModelError([])]).toEqual([0, 0, 0]);
});

test("a changed family is named by its permitted loads", () => {
  const { terms } = api.components.schemas.Adversary.properties;
  const schema = resolveReferences(terms, api.components.schemas) as Schema;
  expect(describeTerms(TERMS, schema)).toBe(
    "Pulse of at most 1.4 N·m on link; Step of at most 1 N·m on link, motor 2",
  );
  expect(describeTerms(Array(9).fill(TERMS[0]), schema)).toHaveLength(200);
});

const lawOf = (law: string, peak: number, faultS: number | null = null): LawTrace => ({
  law,
  fault: faultS === null ? null : "lever_end",
  fault_s: faultS,
  metrics: { peak_position_error_rad: peak },
  position_error_rad: [],
  stiffness_error_nm_per_rad: [],
});

test("laws without a fault are sorted first by error, the others by the time of their fault", () => {
  const ranked = rankLaws([
    lawOf("early", 0.1, 2.5),
    lawOf("poor", 0.3),
    lawOf("late", 9, 4),
    lawOf("good", 0.2),
  ]);
  expect(ranked.map(({ law }) => law)).toEqual(["good", "poor", "late", "early"]);
});

test("the picture starts a second before the first load, or at the start of the run", () => {
  const time = [0, 1, 2, 9];
  const load = (start: number) => ({ kind: "step", start_s: start });
  expect(spanOf({ loads: [load(5), load(3)] } as unknown as Scenario, time)).toEqual({
    from: 2,
    to: 9,
  });
  expect(spanOf({ loads: [load(0.4)] } as unknown as Scenario, time).from).toBe(0);
  expect(spanOf({} as Scenario, time)).toEqual({ from: 0, to: 9 });
});

describe("the displayed search or scenario", () => {
  const at = (more: object) => ({ kind: "falsifier", search: "", scenario: "", laws: [], ...more });
  beforeEach(() => {
    search.value = null;
    kept.value = null;
  });

  test("has an address with the laws to run", () => {
    for (const [address, more] of [
      ["?falsifier=all", {}],
      ["?falsifier=3f2a", { search: "3f2a" }],
      [
        "?falsifier=all&scenario=impulse&laws=ndobc,fl",
        { scenario: "impulse", laws: ["ndobc", "fl"] },
      ],
    ] as const) {
      expect(readPlace(address)).toEqual(at(more));
      expect(writePlace(readPlace(address), "?studies=all&sx=a")).toBe(address);
    }
    expect(writePlace({ kind: "lab" }, "?falsifier=all&scenario=x&laws=a")).toBe("");
  });

  test("is the worst one of a running search with its law, and the simplest one of a finished search", () => {
    place.value = readPlace("?falsifier=3f2a");
    const found = (law: string) => ({ found: { law } });
    search.value = { status: "running", worst: found("fl"), scenario: null } as unknown as Search;
    expect([scenario.value, laws.value]).toEqual([found("fl"), ["fl"]]);
    const simple = { ...found("fl"), loads: [] };
    search.value = { ...search.value, status: "done", scenario: simple } as Search;
    expect([scenario.value, laws.value]).toEqual([simple, ["fl", "ndobc"]]);
    place.value = readPlace("?falsifier=3f2a&laws=esp");
    expect(laws.value).toEqual(["esp"]);
    expect(baselinesOf("ndobc")).toEqual(["ndobc", "fl"]);
  });

  test("is a saved scenario if its name is given, after any search", () => {
    place.value = readPlace("?falsifier=all&scenario=impulse");
    expect(scenario.value).toBeNull();
    const one = { title: "An impulse", found: null };
    kept.value = [{ name: "impulse", title: "An impulse", is_example: false, scenario: one }];
    expect(scenario.value).toEqual(one);
    expect(laws.value).toEqual(["ndobc", "fl"]);
  });

  test("is the example if the address names nothing, until there is a search", () => {
    place.value = readPlace("?falsifier=all");
    kept.value = searches.value = search.value = null;
    expect(chosen.value).toMatchObject({ search: "", scenario: "" });
    const one = { title: "An impulse", found: null };
    searches.value = [];
    kept.value = [{ name: "impulse", title: "An impulse", is_example: true, scenario: one }];
    expect([scenario.value, savedScenario.value?.is_example]).toEqual([one, true]);
    searches.value = [{ id: "3f2a" }, { id: "0b1c" }] as unknown as Search[];
    expect(chosen.value).toMatchObject({ search: "3f2a", scenario: "" });
    expect(savedScenario.value).toBeUndefined();
    place.value = readPlace("?falsifier=all&scenario=impulse");
    expect(savedScenario.value?.is_example).toBe(true);
  });
});

describe("the status of a job", () => {
  const job = (more: object) =>
    ({ status: "running", rate_per_s: 80, left_s: 75, problem: null, ...more }) as never;
  test("shows rate and time left while it runs, and compiling until there is a rate", () => {
    expect(describeJob(job({}))).toEqual(["running", "80 runs/s", "1:15 left"]);
    expect(describeJob(job({ rate_per_s: null, left_s: null }))).toEqual([
      "running",
      "compiling …",
    ]);
  });
  test("is empty for a finished job, and the reason for a failed one", () => {
    expect(describeJob(job({ status: "done" }))).toEqual([]);
    expect(describeJob(job({ status: "failed", problem: "It needs none." }))).toEqual([
      "failed",
      "It needs none.",
    ]);
    expect(describeJob(null)).toEqual([]);
  });
});
