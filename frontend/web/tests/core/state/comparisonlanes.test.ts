import { beforeEach, expect, it, vi } from "vitest";
import type { Lane, LawRow, SessionState } from "../../../src/core/api/types";

const GAINS = { position_coefficients: [1, 4, 6, 4], stiffness_coefficients: [1, 2] };
const POLE = { position_pole_rad_per_s: 54.6 };

function stateOf(law: string, comparisons: Lane[], changes: object = {}): SessionState {
  const lanes = [law, ...comparisons.map((comparison) => comparison.law)].map((name, index) => ({
    ...{ lane: index + 1, id: index + 1, law: name, name },
    segments: [{ number: index + 1, name, line_style: index, start_s: 0, end_s: null }],
  }));
  return {
    ...{ run_number: 1, tick: 0, bench: null, excitation: null, loads: [], lanes },
    configuration: {
      ...{ law, comparisons, gains: GAINS, parameters: { fl_integral: POLE } },
      observer: { bandwidth_rad_per_s: [60, 60, 60] },
    },
    ...changes,
  } as unknown as SessionState;
}

const law = (name: string, changes: Partial<LawRow> = {}): LawRow => ({
  ...{ name, title: name.toUpperCase(), line_style: 0, summary: "", equation: "u=0", source: "" },
  ...{ notes: "", estimate: "none", takes_gains: false, parameters: [], problem: null },
  ...changes,
});

let sent: { path: string; body: unknown }[] = [];
let answer = () => stateOf("ndobc", []);

beforeEach(() => {
  vi.resetModules();
  vi.stubGlobal("window", new EventTarget());
  vi.stubGlobal("document", { baseURI: "http://lab/" });
  vi.stubGlobal("location", { search: "" });
  sent = [];
  answer = () => stateOf("ndobc", []);
  vi.stubGlobal("fetch", async (address: URL | string, { body }: RequestInit) => {
    sent.push({
      path: String(address).split("/sessions/")[1] as string,
      body: JSON.parse(String(body)),
    });
    return new Response(JSON.stringify(answer()), {
      headers: { "Content-Type": "application/json" },
    });
  });
});

it("the law of the session is added with a copy of its settings, another law without", async () => {
  const { laws } = await import("../../../src/core/state/laws");
  const { addLane } = await import("../../../src/core/state/commands");
  laws.value = [law("ndobc", { takes_gains: true }), law("fl_integral")];
  await addLane(stateOf("ndobc", []), "ndobc");
  await addLane(stateOf("ndobc", [{ law: "ndobc" }]), "fl_integral");
  await addLane(stateOf("fl_integral", []), "fl_integral");
  expect(sent.map(({ body }) => body)).toEqual([
    { comparisons: [{ law: "ndobc", gains: GAINS }] },
    { comparisons: [{ law: "ndobc" }, { law: "fl_integral" }] },
    { comparisons: [{ law: "fl_integral", parameters: POLE }] },
  ]);
});

it("a controller is removed by its lane, and the twin of a bench is no comparison lane", async () => {
  const { comparisonLanes } = await import("../../../src/core/state/lanes");
  const { removeLane } = await import("../../../src/core/state/commands");
  const comparisons = [{ law: "ndobc" }, { law: "fl" }, { law: "fl_integral", parameters: POLE }];
  const bench = stateOf("ndobc", comparisons, { bench: {} });
  expect(comparisonLanes(bench).map(({ lane, controller }) => [lane, controller.law])).toEqual([
    [3, "fl"],
    [4, "fl_integral"],
  ]);
  await removeLane(bench, 3);
  expect(sent[0]?.body).toEqual({ comparisons: [{ law: "fl_integral", parameters: POLE }] });
});

it("only a lane without its own settings is exchanged with the law of the session", async () => {
  const { comparisonLaws } = await import("../../../src/core/state/lanes");
  expect(comparisonLaws("fl", stateOf("ndobc", [{ law: "fl", gains: null }]))).toEqual(["ndobc"]);
  const own = stateOf("ndobc", [{ law: "fl", gains: GAINS } as unknown as Lane]);
  expect(comparisonLaws("fl", own)).toEqual([]);
});

it("undo restores the lanes that differ, and only the tuned ones of the removed lanes", async () => {
  const {
    restoringRequests: callsBack,
    designOf,
    isSame,
  } = await import("../../../src/lab/design/history");
  const { Edit } = await import("../../../src/core/api/operations");
  const slow = { law: "fl_integral", parameters: { position_pole_rad_per_s: 40 } };
  const fast = { law: "fl_integral", parameters: { position_pole_rad_per_s: 70 } };
  const before = stateOf("ndobc", [slow]);
  const after = stateOf("ndobc", [fast]);
  after.configuration.parameters = { fl_integral: { position_pole_rad_per_s: 60 } };
  expect(isSame(designOf(before), designOf(after))).toBe(false);
  for (const call of callsBack(designOf(before), after))
    await call(new Edit(null, { revision: null }));
  expect(sent).toEqual([
    { path: "lab/parameters", body: { fl_integral: POLE } },
    { path: "lab/lanes/2", body: slow },
  ]);
  const plain = stateOf("ndobc", [{ law: "fl" }]);
  const gone = stateOf("ndobc", []);
  expect(isSame(designOf(plain), designOf(gone))).toBe(true);
  expect(callsBack(designOf(plain), gone)).toEqual([]);
  expect(isSame(designOf(before), designOf(gone))).toBe(false);
  for (const call of callsBack(designOf(before), gone))
    await call(new Edit(null, { revision: null }));
  expect(sent.at(-1)).toEqual({ path: "lab/lanes", body: { comparisons: [slow] } });
  expect(isSame(designOf(before), designOf(plain))).toBe(false);
});

it("undo restores a removed tuned lane first and then its earlier settings", async () => {
  const { session } = await import("../../../src/core/state/session");
  const { steps, undo, watchDesign } = await import("../../../src/lab/design/history");
  const tuned = (pole: number) => ({ law: "fl", parameters: { position_pole_rad_per_s: pole } });
  const show = (comparisons: Lane[], id: number) => {
    const state = stateOf("ndobc", comparisons);
    for (const lane of state.lanes.slice(1)) lane.id = id;
    session.value = state;
    return state;
  };
  watchDesign();
  for (const lanes of [[tuned(40)], [tuned(60)], []]) show(lanes, 2);
  expect(steps.value).toHaveLength(2);
  answer = () => show([tuned(60)], 3);
  await undo();
  answer = () => show([tuned(40)], 3);
  await undo();
  expect(sent).toEqual([
    { path: "lab/lanes", body: { comparisons: [tuned(60)] } },
    { path: "lab/lanes/2", body: tuned(40) },
  ]);
  expect(steps.value).toEqual([]);
});

it("the comparison is switched on again with the last comparison lanes", async () => {
  const { laws } = await import("../../../src/core/state/laws");
  const { session } = await import("../../../src/core/state/session");
  const { watchComparisons } = await import("../../../src/core/state/lanes");
  const { toggleCompare } = await import("../../../src/core/state/commands");
  laws.value = [law("ndobc"), law("fl"), law("fl_integral")];
  watchComparisons();
  await toggleCompare(stateOf("ndobc", []));
  const lanes = [{ law: "fl_integral", parameters: POLE }, { law: "fl" }];
  session.value = stateOf("ndobc", lanes);
  await toggleCompare(session.value);
  session.value = stateOf("ndobc", []);
  await toggleCompare(session.value);
  await toggleCompare(stateOf("fl", []));
  expect(sent.map(({ body }) => body)).toEqual([
    { comparisons: [{ law: "fl" }] },
    { comparisons: [] },
    { comparisons: lanes },
    { comparisons: lanes.slice(0, 1) },
  ]);
});

it("laws are found by any of their words and grouped by the estimate that they use", async () => {
  const { findLaws, groupLaws } = await import("../../../src/core/state/laws");
  const listed = [
    law("fl", { summary: "Cancels the model it knows" }),
    law("ndobc", { summary: "Estimates the load", estimate: "observer" }),
    law("eso", { summary: "An observer of its own", estimate: "own" }),
  ];
  expect(findLaws(listed, " MODEL  knows ").map(({ name }) => name)).toEqual(["fl"]);
  expect(findLaws(listed, "")).toHaveLength(3);
  expect(findLaws(listed, "cancels load")).toEqual([]);
  expect(groupLaws(listed).map(({ estimate, laws }) => [estimate, laws.length])).toEqual([
    ["observer", 1],
    ["own", 1],
    ["none", 1],
  ]);
});

it("equal poles give the coefficients of a power", async () => {
  const { coefficientsOf } = await import("../../../src/lab/design/poles");
  expect(coefficientsOf(4, 1)).toEqual([1, 4, 6, 4]);
  expect(coefficientsOf(2, 30)).toEqual([900, 60]);
});
