import "../../browserless";
import { beforeEach, describe, expect, it } from "vitest";
import { calls, clearCalls, logCall, logDownload } from "../../../src/core/api/calls";
import type { CommandKind, RunOrigin } from "../../../src/core/api/types";
import { writeCommand } from "../../../src/lab/script/commands";
import { writeExperiment } from "../../../src/lab/script/experiment";
import { buildValue, toPython, toSnippet, toSnippets } from "../../../src/lab/script/snippets";

const LAB = new URL("http://127.0.0.1:8000/api/v1/");
const load = { method: "post", path: "sessions/lab/loads", body: { kind: "paper" } };

describe("the calls of the page", () => {
  beforeEach(clearCalls);

  it("are the changing ones, with the time from the response", () => {
    logCall("get", "sessions/lab", undefined, 200);
    logCall("post", "references/preview", { kind: "constant" }, 200, { time_s: [0] });
    logCall("post", "sessions/lab/loads", { kind: "paper" }, 201, { time_s: 2.5 });
    logCall("put", "sessions/lab/speed", { speed: 99 }, 422, { message: "no" });
    logDownload("runs/a/export?kind=csv");
    expect(calls.value.map(({ path, status, timeS }) => [path, status, timeS])).toEqual([
      ["sessions/lab/loads", 201, 2.5],
      ["sessions/lab/speed", 422, null],
      ["runs/a/export?kind=csv", 200, null],
    ]);
  });

  it("never contain the secret", () => {
    logCall("post", "login", { secret: "correct horse" }, 204);
    expect(calls.value).toEqual([]);
  });

  it("are limited to the newest 200", () => {
    for (let index = 0; index < 250; index++) logCall("put", String(index), undefined, 200);
    expect(calls.value).toHaveLength(200);
    expect(calls.value.at(-1)?.path).toBe("249");
  });
});

describe("a call as code", () => {
  it("is one line of Python or of a shell", () => {
    expect(toSnippet(load, "python", LAB)).toBe(
      'httpx.post("http://127.0.0.1:8000/api/v1/sessions/lab/loads", json={"kind": "paper"})',
    );
    expect(toSnippet(load, "curl", LAB)).toBe(
      "curl -X POST 'http://127.0.0.1:8000/api/v1/sessions/lab/loads'" +
        ` -H 'Content-Type: application/json' -d '{"kind":"paper"}'`,
    );
    expect(toSnippets([load], "python", LAB)).toMatch(/^import httpx\n\nhttpx\.post/);
  });

  it("escapes every quote", () => {
    const named = { method: "post", path: "a", body: { name: `it's "1"\n\\$(x)` } };
    expect(toSnippet(named, "curl", LAB)).toContain(`it'\\''s`);
    expect(toSnippet(named, "python", LAB)).toContain('"it\'s \\"1\\"\\n\\\\$(x)"');
  });

  it("writes None, True and False", () => {
    expect(toPython({ a: null, b: [true, false, 1.5], c: undefined })).toBe(
      '{"a": None, "b": [True, False, 1.5]}',
    );
  });

  it("breaks a long value into lines", () => {
    const long = Object.fromEntries(Array.from({ length: 9 }, (_, i) => [`a_long_name_${i}`, i]));
    expect(buildValue("svsa.A", long, "").split("\n")).toHaveLength(11);
    expect(buildValue("svsa.A", { b: 1 }, "")).toBe("svsa.A(b=1)");
  });
});

const DEFAULTS = {
  law: "ndobc",
  comparisons: [],
  effects: {},
  seed: 0,
  position: { kind: "sine" },
  stiffness: { kind: "constant", stiffness_nm_per_rad: 15 },
  gains: { position_coefficients: [1] },
  observer: { bandwidth_rad_per_s: [60, 60, 60] },
  actuator: { link_inertia_kg_m2: 0.01, joint_offset_m: null },
  nominal: { link_inertia_kg_m2: 0.01 },
  loads: [],
};
const origin = (change: object, commands: RunOrigin["commands"] = []): RunOrigin => ({
  configuration: { ...DEFAULTS, ...change },
  commands,
  first_tick: 0,
  tick: 7250,
  period_s: 0.001,
  plant: "simulated",
  opening: { from: "figure", figure: "4a", load: false },
  defaults: DEFAULTS,
  problem: null,
});
const given = (tick: number, kind: CommandKind, argument: unknown) =>
  ({ tick, command: { tick, kind, argument } }) as RunOrigin["commands"][number];

describe("an experiment as a script", () => {
  it("states where a bench was stopped, which a simulation cannot repeat", () => {
    const script = writeExperiment(origin({}, [given(2500, "stop", null)]), "bench", "http://lab");
    expect(script).toContain("# Here the bench was stopped");
  });

  it("sends every command at its time and runs to the end", () => {
    const script = writeExperiment(
      origin({}, [
        given(2500, "load", { kind: "paper", start_s: null }),
        given(2500, "law", "fl"),
        given(4000, "unload", 1),
      ]),
      "3 kg",
      "http://lab",
    );
    const lines = script.split("\n").map((line) => line.trim());
    const from = lines.indexOf("session.reset()");
    expect(lines.slice(from + 1, from + 7)).toEqual([
      "session.run_until(2.5)",
      "session.loads.add(svsa.PaperLoad())",
      'session.law = "fl"',
      "session.run_until(4)",
      "session.loads.remove(1)",
      "session.run_until(7.25)",
    ]);
  });

  it("states where the recording starts, and simulates the time before it", () => {
    const load = [given(2500, "load", { kind: "paper" }), given(7100, "unload", 1)];
    const late = { ...origin({}, load), first_tick: 7000 };
    const script = writeExperiment(late, "a", "http://lab");
    expect(script).toContain("The recording begins at 7 s");
    expect(script.match(/session\.run_until.*/g)).toEqual([
      "session.run_until(2.5)",
      "session.run_until(7)  # Here the recording begins.",
      "session.run_until(7.1)",
      "session.run_until(7.25)",
    ]);
    const whole = writeExperiment(origin({}, load), "a", "http://lab");
    expect(whole).not.toContain("recording begins");
  });

  it("restarts a reference that is already followed", () => {
    const other = { kind: "constant", position_rad: 0.5 };
    const commands = [
      given(100, "position", { kind: "sine" }),
      given(200, "position", other),
      given(300, "position", other),
    ];
    const script = writeExperiment(origin({}, commands), "a", "http://lab");
    expect(script.match(/session\.(position = |repeat).*/g)).toEqual([
      "session.repeat_position()",
      "session.position = svsa.ConstantPosition(position_rad=0.5)",
      "session.repeat_position()",
    ]);
  });

  it("sets only what differs from a new session", () => {
    const plain = writeExperiment(origin({}), "a", "http://lab");
    expect(plain).not.toMatch(/session\.\w+ = /);
    const changed = writeExperiment(
      origin({
        stiffness: { kind: "constant", stiffness_nm_per_rad: 60 },
        actuator: { link_inertia_kg_m2: 0.02, joint_offset_m: null },
        comparisons: [{ law: "fl", gains: null }],
      }),
      "a",
      "http://lab",
    );
    expect(changed.match(/session\.\w+ = .*/g)).toEqual([
      "session.stiffness = svsa.ConstantStiffness(stiffness_nm_per_rad=60)",
      'session.comparisons = [svsa.Lane(law="fl")]',
      "session.actuator = session.actuator.changed(link_inertia_kg_m2=0.02)",
    ]);
  });

  it("opens a session with another actuator, which the shared session cannot have", () => {
    const opening = { from: "actuator", actuator: "qbmove", load: false };
    const script = writeExperiment({ ...origin({}), opening }, "a", "http://lab");
    expect(script).toContain('{"actuator": "qbmove", "load": False, "law": "ndobc"}');
    expect(script).toContain("lab.new_session(**settings)");
    expect(script).not.toContain("shared");
    expect(writeExperiment(origin({}), "a", "http://lab")).toContain("--shared");
  });

  it("sets each joint of an arm, and the arm", () => {
    const links = { chain: [{ length_m: 0.3 }] };
    const arm = { links, model: links, feedforward: false, adaptation: null, tip: null };
    const plain = { ...DEFAULTS, arm: { ...arm, other_joints: [DEFAULTS] } };
    const joint2 = {
      ...DEFAULTS,
      law: "fl",
      comparisons: [{ law: "pd", gains: null }],
      loads: [{ kind: "constant", torque_nm: [1, 0, 0], start_s: 5 }],
    };
    const configuration = {
      ...plain,
      comparisons: [{ law: "fl", gains: null }],
      loads: [{ kind: "tip_mass", mass_kg: 0.1 }],
      arm: { ...arm, feedforward: true, adaptation: { mass_max_kg: 1 }, other_joints: [joint2] },
    };
    const repeated = given(100, "position", { kind: "sine" });
    repeated.command = { ...repeated.command, joint: 2 };
    const commands = [repeated, given(200, "law", "fl"), given(300, "adaptation", null)];
    const opening = { from: "arm", arm: "rods" };
    const changed = { ...origin({}, commands), configuration, defaults: plain, opening };
    expect(writeExperiment(changed, "a", "http://lab").match(/^ +(session|joint).*/gm)).toEqual(
      [
        "joint1, joint2 = map(session.open_joint, (1, 2))",
        "session.pause()",
        'session.comparisons = [svsa.Lane(law="fl")]',
        'joint2.law = "fl"',
        'joint2.set_lane(2, svsa.Lane(law="pd"))',
        'session.change_arm(feedforward=True, adaptation={"mass_max_kg": 1})',
        "session.reset()",
        "joint1.loads.add(svsa.TipMass(mass_kg=0.1))",
        "joint2.loads.add(svsa.ConstantLoad(torque_nm=[1, 0, 0], start_s=5))",
        "session.run_until(0.1)",
        "joint2.repeat_position()",
        "session.run_until(0.2)",
        'joint1.law = "fl"',
        'joint2.law = "fl"',
        "session.run_until(0.3)",
        "session.change_arm(adaptation=None)",
        "session.run_until(7.25)",
      ].map((line) => `        ${line}`),
    );
  });

  it("cannot be broken by a name with special characters", () => {
    const script = writeExperiment(origin({}), '"""\nimport os\n"""\\', "http://lab");
    expect(script.split("\n")[0]).toBe(
      `"""''' import os '''/: an experiment of SVSA Lab, 0 to 7.25 s, to be run again.`,
    );
  });

  it("has a text for every kind of command", () => {
    expect(writeCommand("comparisons", [])).toEqual(["session.comparisons = []"]);
    const setting = { lane: 3, setting: { law: "fl", gains: null } };
    expect(writeCommand("lane", setting)).toEqual(['session.set_lane(3, svsa.Lane(law="fl"))']);
    expect(writeCommand("laws", ["fl", "ndobc"])).toEqual(['session.set_laws("fl", "ndobc")']);
    const jerk = { kind: "minimum_jerk", start_rad: 0, end_rad: 1 };
    expect(writeCommand("position", jerk)).toEqual([
      "session.position = svsa.MinimumJerkPosition(start_rad=0, end_rad=1)",
    ]);
    expect(writeCommand("actuator", { mechanism: "qbmove", a: 1 }, "joint2")).toEqual([
      "joint2.actuator = joint2.actuator.changed(a=1)",
    ]);
    const parameters = { fl_integral: { position_pole_rad_per_s: 50 } };
    expect(writeCommand("parameters", parameters)).toEqual([
      'session.set_parameters("fl_integral", position_pole_rad_per_s=50)',
    ]);
  });
});
