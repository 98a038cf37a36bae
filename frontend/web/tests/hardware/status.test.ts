import "../browserless";
import { describe, expect, it } from "vitest";
import type { BenchState, SessionState } from "../../src/core/api/types";
import { isRealBench, plantKindOfBench } from "../../src/core/state/plant";
import {
  adviceFor,
  allowedCommands,
  barsOf,
  freshnessOf,
  isStoppedSimulation,
  needsDetails,
  STAGES,
  stagePosition,
} from "../../src/hardware/status";

const HOMED = { done: ["link", "motor1", "motor2"], next_step: null, instruction: "" };
const UNHOMED = { done: [], next_step: "link", instruction: "Turn the link to its mark." };

/** The defaults of a bench file. */
const BOUNDS = { stale_zero_s: 0.005, stale_fault_s: 0.02 };
const TICKING = { state: "ticking" };
const bench = (change: object) =>
  ({
    status: "off",
    problems: [],
    homing: HOMED,
    loop: TICKING,
    ...BOUNDS,
    ...change,
  }) as unknown as BenchState;
const allowed = (change: object) =>
  Object.entries(allowedCommands(bench(change)))
    .filter(([, isAllowed]) => isAllowed)
    .map(([name]) => name);

describe("the states of a bench", () => {
  it("are shown as a sequence, in which a ramp belongs to the last stage", () => {
    const places = (status: BenchState["status"]) =>
      STAGES.map((stage) => stagePosition(stage, status));
    expect(places("config")).toEqual(["done", "done", "here", "ahead", "ahead", "ahead"]);
    expect(places("ramp")).toEqual(places("run"));
    expect(new Set(places("fault"))).toEqual(new Set(["ahead"]));
    const unknown = STAGES.map((stage) => stagePosition(stage, null));
    expect(new Set(unknown), "without a connection it is nowhere").toEqual(new Set(["ahead"]));
  });

  it("allow the calls that the server accepts, and none while the drives start up", () => {
    expect(allowed({})).toEqual(["arm"]);
    expect(allowed({ problems: ["No calibration."] })).toEqual([]);
    expect(allowed({ status: "mode" })).toEqual([]);
    expect(allowed({ status: "ready" })).toEqual(["run"]);
    const deadMan = bench({ status: "ready", dead_man: true });
    expect([allowedCommands(deadMan).run, allowedCommands(deadMan, true).run]).toEqual([
      false,
      true,
    ]);
    expect(allowed({ status: "ready", homing: UNHOMED })).toEqual(["home"]);
    expect(allowed({ homing: UNHOMED }), "marks are confirmed in READY only").toEqual(["arm"]);
    expect(allowed({ status: "run" })).toEqual(["stop"]);
    expect(allowed({ status: "ramp" })).toEqual([]);
    expect(allowed({ status: "fault", homing: UNHOMED })).toEqual(["clear"]);
    const lost = { status: "fault", loop: { state: "gone" } };
    expect(allowed(lost), "a lost loop is restarted, not cleared").toEqual(["restart"]);
    expect(allowed({ ...lost, loop: { state: "not_opened" } })).toEqual(["restart"]);
    expect(allowed({ ...lost, loop: { state: "starting" } })).toEqual([]);
    expect(allowed({ loop: { state: "starting" } }), "it takes no command yet").toEqual([]);
  });

  it("name the next action", () => {
    expect(adviceFor(bench({ problems: ["No calibration."] }))).toBe("problems");
    const off = { supervised: true, ages_s: [1000, 1000, 0.001] };
    expect(adviceFor(bench(off))).toBe("arm");
    expect(adviceFor(bench({ ...off, ages_s: [1000, 1000, 1000] }))).toBe("unheard");
    expect(adviceFor(bench({ ...off, supervised: false }))).toBe("unsupervised");
    for (const status of ["off", "run", "fault"]) {
      expect(adviceFor(bench({ status, loop: { state: "silent" } }))).toBe("loop");
      expect(adviceFor(bench({ status, loop: { state: "starting" } }))).toBe("starting");
    }
    const closed = bench({ status: "fault", loop: { state: "not_opened" } });
    expect(adviceFor(closed), "nothing was lost that never ticked").toBe("notOpened");
    expect(adviceFor(bench({ status: "ready", homing: UNHOMED }))).toBe("home");
    const guarded = bench({ status: "ready", dead_man: true });
    expect([adviceFor(guarded), adviceFor(guarded, true)]).toEqual(["hold", "run"]);
    expect(adviceFor(bench({ status: "reset" }))).toBe("wait");
    expect(adviceFor(bench({ status: "fault" }))).toBe("clear");
    expect(needsDetails(bench({ status: "ready", homing: UNHOMED }))).toBe(true);
    expect(needsDetails(bench({ status: "run", homing: UNHOMED }))).toBe(false);
    const starting = { homing: UNHOMED, loop: { state: "starting" } };
    expect(adviceFor(bench(starting))).toBe("starting");
    expect(needsDetails(bench(starting)), "nothing can be done about it yet").toBe(false);
  });
});

describe("the kind of a bench", () => {
  it("is shown only after the bus has reported it", () => {
    const marks = [true, false, null].map((emulated) => plantKindOfBench(bench({ emulated })));
    expect(marks).toEqual(["emulated", "real", "unknown"]);
  });

  it("counts as real hardware until it is known to be emulated", () => {
    expect([true, false, null].map((emulated) => isRealBench(bench({ emulated })))).toEqual([
      false,
      true,
      true,
    ]);
    expect(isRealBench(null)).toBe(false);
  });
});

describe("a quick stop of a simulation", () => {
  const state = (change: object) =>
    ({
      bench: null,
      status: "paused",
      tick: 700,
      events: [{ tick: 700, kind: "quick_stop" }],
      ...change,
    }) as unknown as SessionState;

  it("is shown until the simulation continues", () => {
    expect(isStoppedSimulation(state({}))).toBe(true);
    expect(isStoppedSimulation(state({ status: "running" }))).toBe(false);
    expect(isStoppedSimulation(state({ tick: 710 }))).toBe(false);
    expect(isStoppedSimulation(state({ events: [] }))).toBe(false);
  });
});

describe("lateness", () => {
  it("shows one late tick among a million punctual ones", () => {
    const bars = barsOf([1e-5, 1e-4], [1_000_000, 1, 0]);
    expect(bars.map((bar) => bar.edgeS)).toEqual([1e-5, 1e-4, null]);
    expect(bars[0]?.height).toBe(1);
    expect(bars[1]?.height).toBeGreaterThan(0.04);
    expect(bars[2]?.height).toBe(0);
  });

  it("calls a reading stale above 5 ms and lost above 20 ms", () => {
    expect(
      [0.001, 0.005, 0.006, 0.02, 0.021, Number.NaN].map((age) => freshnessOf(age, BOUNDS)),
    ).toEqual(["fresh", "fresh", "stale", "stale", "lost", "lost"]);
  });

  it("calls a loop silent, never lost, if it need not send", () => {
    expect(freshnessOf(1000, BOUNDS, false)).toBe("silent");
    expect(freshnessOf(1000, BOUNDS), "unknown since when").toBe("unheard");
    expect(freshnessOf(0.001, BOUNDS, false)).toBe("fresh");
    const patient = { stale_zero_s: 0.05, stale_fault_s: 0.2 };
    const levels = [0.04, 0.06, 0.21].map((age) => freshnessOf(age, patient));
    expect(levels, "a bench file has bounds of its own").toEqual(["fresh", "stale", "lost"]);
  });
});
