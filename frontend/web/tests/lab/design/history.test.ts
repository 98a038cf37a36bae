import { beforeEach, expect, it, vi } from "vitest";
import type { SessionState } from "../../../src/core/api/types";

const REFERENCES = {
  position: { kind: "sine", amplitude_rad: 0.2 },
  stiffness: { kind: "constant", value_nm_per_rad: 15 },
};
const NONE = { friction: null };

interface Row {
  id: number;
  joint: number | null;
  end_s: number | null;
  load: { kind: string; start_s: number | null };
}

const row = (id: number, kind: string, endS: number | null = null): Row => ({
  id,
  joint: null,
  end_s: endS,
  load: { kind, start_s: id },
});

function stateOf(configuration: object, loads: Row[] = [], rest: object = {}): SessionState {
  return {
    ...{ run_number: 1, bench: null, lanes: [{ id: 1 }], excitation: null, revision: "1" },
    ...rest,
    loads,
    configuration: {
      ...{ law: "ndobc", comparisons: [], effects: NONE, parameters: {}, ...REFERENCES },
      gains: { position_coefficients: [1, 4, 6, 4], stiffness_coefficients: [1, 2] },
      observer: { bandwidth_rad_per_s: [60, 60, 60] },
      ...configuration,
    },
  } as unknown as SessionState;
}

let sent: [string, string, unknown][] = [];

beforeEach(() => {
  vi.resetModules();
  vi.stubGlobal("window", new EventTarget());
  vi.stubGlobal("document", { baseURI: "http://lab/" });
  vi.stubGlobal("location", { search: "" });
  sent = [];
  vi.stubGlobal("fetch", async (address: URL | string, { method, body }: RequestInit) => {
    const path =
      String(address)
        .split("/sessions/")[1]
        ?.replace(/^[^/]*/, "") ?? "";
    sent.push([String(method), path, body ? JSON.parse(String(body)) : null]);
    return new Response(JSON.stringify(stateOf({})), {
      headers: { "Content-Type": "application/json" },
    });
  });
});

/** The requests that lead back from one state to another. */
async function back(to: SessionState, from: SessionState) {
  const { restoringRequests: callsBack, designOf } = await import(
    "../../../src/lab/design/history"
  );
  const { Edit } = await import("../../../src/core/api/operations");
  const edit = new Edit(null, { revision: null });
  for (const call of callsBack(designOf(to), from)) await call(edit);
  return sent.filter(([method]) => method.toLowerCase() !== "get");
}

it("undo restores a law, an effect and a reference", async () => {
  const before = stateOf({});
  const after = stateOf({
    ...{ law: "fl", effects: { friction: { coulomb_nm: 0.1 } } },
    position: { kind: "constant", value_rad: 0 },
  });
  const calls = await back(before, after);
  expect(calls.map(([, path, body]) => [path, body])).toEqual([
    ["/law", { law: "ndobc" }],
    ["/effects", NONE],
    ["/position", REFERENCES.position],
  ]);
});

it("undo removes an added load, and adds a removed one now", async () => {
  const calls = await back(stateOf({}, [row(1, "paper")]), stateOf({}, [row(2, "mass")]));
  expect(calls.map(([method, path, body]) => [method.toLowerCase(), path, body])).toEqual([
    ["post", "/loads", { kind: "paper", start_s: null }],
    ["delete", "/loads/2", null],
  ]);
});

it("undo removes one of two equal loads", async () => {
  const calls = await back(
    stateOf({}, [row(1, "mass")]),
    stateOf({}, [row(1, "mass"), row(2, "mass")]),
  );
  expect(calls.map(([, path]) => path)).toEqual(["/loads/2"]);
});

it("an ended pulse, a load of the previous run and a manual load are no steps", async () => {
  const { designOf, isSame } = await import("../../../src/lab/design/history");
  const alike = (one: SessionState, other: SessionState) => isSame(designOf(one), designOf(other));
  expect(alike(stateOf({}, [row(1, "pulse", 2)]), stateOf({}))).toBe(true);
  expect(alike(stateOf({}, [row(1, "mass")]), stateOf({}, [], { run_number: 2 }))).toBe(true);
  const bench = { bench: { emulated: false } };
  expect(alike(stateOf({}, [row(1, "mass")], bench), stateOf({}, [], bench))).toBe(true);
  expect(alike(stateOf({}, [row(1, "mass")]), stateOf({}))).toBe(false);
});

it("the motion of an identification is no step, because the reference is restored", async () => {
  const { steps, watchDesign } = await import("../../../src/lab/design/history");
  const { session } = await import("../../../src/core/state/session");
  watchDesign();
  session.value = stateOf({});
  const excited = { position: { kind: "excitation" } };
  session.value = stateOf(excited, [], { excitation: { progress: 0 } });
  session.value = stateOf({});
  expect(steps.value).toEqual([]);
  session.value = stateOf({ law: "fl" });
  expect(steps.value.map(({ joints }) => joints[0]?.law)).toEqual(["ndobc"]);
});

// The answer of the server has no load.
it("keeps the steps before the last ones that equal the current state", async () => {
  const { steps, undo, watchDesign } = await import("../../../src/lab/design/history");
  const { session } = await import("../../../src/core/state/session");
  watchDesign();
  for (const loads of [[], [row(1, "mass")], [], [row(2, "mass")]]) {
    session.value = stateOf({}, loads);
  }
  session.value = stateOf({ law: "fl" }, [row(2, "mass")]);
  await undo();
  expect(steps.value.map(({ loads }) => loads.length)).toEqual([0, 1, 0]);
  await undo();
  expect(steps.value.map(({ loads }) => loads.length)).toEqual([0]);
});

const MOTION = { kind: "constant", value_rad: 0.1 };

/** A session of an arm. */
function armOf(second: object, parts: object = {}, loads: Row[] = []): SessionState {
  const { configuration: joint2 } = stateOf(second);
  return stateOf(
    { arm: { feedforward: false, adaptation: null, tip: null, other_joints: [joint2], ...parts } },
    loads,
  );
}

it("undo restores the settings of each joint of an arm, and the loads on it", async () => {
  const load = {
    ...row(1, "constant"),
    joint: 2,
    load: { kind: "constant", torque_nm: [1, 0, 0] },
  };
  const before = armOf({}, {}, [load as unknown as Row]);
  const after = armOf({ law: "fl", position: MOTION }, { feedforward: true });
  const calls = await back(before, after);
  expect(calls.map(([, path, body]) => [path, body])).toEqual([
    ["/arm", { feedforward: false }],
    ["/law?joint=2", { law: "ndobc" }],
    ["/position?joint=2", REFERENCES.position],
    ["/loads?joint=2", { ...load.load, start_s: null }],
  ]);
});

it("the reference of a joint is restored while the tip has none", async () => {
  const tip = { kind: "ellipse" };
  const plain = armOf({});
  const led = armOf({ position: MOTION }, { tip });
  const paths = async (to: SessionState, from: SessionState) => {
    sent = [];
    return (await back(to, from)).map(([, path]) => path);
  };
  expect(await paths(plain, led)).toEqual(["/arm", "/position?joint=2"]);
  expect(await paths(led, plain)).toEqual(["/position?joint=2", "/arm"]);
});
