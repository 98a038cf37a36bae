import { describe, expect, it } from "vitest";
import type { Step } from "../../../src/core/api/course";
import type { BenchState, SessionState } from "../../../src/core/api/types";
import {
  criteriaOf,
  dueManualLoad,
  findInterruption,
  isOfSession,
  isPossibleOn,
  readinessOf,
} from "../../../src/teaching/course/benchstep";

const bench = (change: object = {}) =>
  ({
    status: "ready",
    problems: [],
    supervised: true,
    ages_s: [0, 0, 0],
    dead_man: false,
    homing: { next_step: null },
    loop: { state: "ticking" },
    ...change,
  }) as unknown as BenchState;
const of = (bench: object | null) => ({ criteria: ["simulated"], bench }) as unknown as Step;
const HUNG = of({
  criteria: ["on a bench"],
  manual_load: "hang 3 kg",
  manual_loads: [
    { time_s: 5, is_on: true },
    { time_s: 8, is_on: false },
  ],
});
const state = (change: object) =>
  ({ time_s: 4, bench: bench({ status: "run" }), ...change }) as unknown as SessionState;

describe("the actions that a step may request of a bench", () => {
  it("are all if the bench is ready and homed, and in a simulation", () => {
    const all = { canConfigure: true, canRun: true, nextAction: null };
    expect(readinessOf(bench(), false)).toEqual(all);
    expect(readinessOf(null, false)).toEqual(all);
  });

  it("exclude the start before the required actions, which are named", () => {
    const ready = (change: object, held = false) => readinessOf(bench(change), held);
    expect(ready({ status: "ready", homing: { next_step: "link" } })).toMatchObject({
      canRun: false,
      nextAction: "home",
    });
    expect(ready({ dead_man: true })).toMatchObject({ canRun: false, nextAction: "hold" });
    expect(ready({ dead_man: true }, true)).toMatchObject({ canRun: true, nextAction: null });
    expect(ready({ status: "fault" }).nextAction).toBe("clear");
  });

  it("are none while the bench moves or its loop does not tick", () => {
    expect(readinessOf(bench({ status: "run" }), false)).toEqual({
      canConfigure: false,
      canRun: false,
      nextAction: null,
    });
    expect(readinessOf(bench({ status: "ramp" }), false).nextAction).toBe("ramping");
    const silent = readinessOf(bench({ loop: { state: "silent" } }), false);
    expect(silent).toMatchObject({ canConfigure: false, canRun: false });
  });
});

describe("a step on a bench", () => {
  it("is possible only if the exercise defines it for a bench, with its own criteria", () => {
    expect(isPossibleOn(of(null), bench())).toBe(false);
    expect(isPossibleOn(of(null), null)).toBe(true);
    expect(isPossibleOn(HUNG, bench())).toBe(true);
    expect(criteriaOf(HUNG, bench())).toEqual(["on a bench"]);
    expect(criteriaOf(HUNG, null)).toEqual(["simulated"]);
  });

  it("names the manual actions until shortly after them", () => {
    expect(dueManualLoad(HUNG, 0)?.time_s).toBe(5);
    expect(dueManualLoad(HUNG, 6.9)?.time_s).toBe(5);
    expect(dueManualLoad(HUNG, 7)?.is_on).toBe(false);
    expect(dueManualLoad(HUNG, 11)).toBeNull();
    expect(dueManualLoad(of(null), 0)).toBeNull();
  });

  it("is interrupted if control is lost or the bench is stopped, and not before it runs", () => {
    expect(findInterruption(state({}), true)).toBeNull();
    expect(findInterruption(state({}), false)).toBe("control");
    expect(findInterruption(state({ bench: null }), false)).toBe("control");
    expect(findInterruption(state({ bench: bench({ status: "ramp" }) }), true)).toBe("stopped");
    expect(findInterruption(state({ bench: bench(), time_s: 0 }), true)).toBeNull();
    expect(findInterruption(state({ bench: bench({ status: "fault" }) }), true)).toBeNull();
  });
});

describe("the session of a step", () => {
  const step = (arm: string) => ({ arm }) as unknown as Step;
  const session = (arm: object | null) => state({ configuration: { arm } });

  it("is one of an arm for a step of an arm, and of a single joint for all others", () => {
    expect(isOfSession(step("rods"), session({}))).toBe(true);
    expect(isOfSession(step("rods"), session(null))).toBe(false);
    expect(isOfSession(step(""), session(null))).toBe(true);
    expect(isOfSession(step(""), session({}))).toBe(false);
    expect(isOfSession(step("rods"), null)).toBe(true);
  });
});
