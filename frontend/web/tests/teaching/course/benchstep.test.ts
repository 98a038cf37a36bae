import { describe, expect, it } from "vitest";
import type { Step } from "../../../src/core/api/course";
import type { BenchState, SessionState } from "../../../src/core/api/types";
import {
  askedOf,
  findCut,
  handDue,
  isDoneHere,
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

describe("what a bench may be asked for by a step", () => {
  it("is all of it where it is ready and at home, and in a simulation", () => {
    const all = { mayBeSet: true, mayRun: true, before: null };
    expect(readinessOf(bench(), false)).toEqual(all);
    expect(readinessOf(null, false)).toEqual(all);
  });

  it("is no start before the required actions, which are named", () => {
    const ready = (change: object, held = false) => readinessOf(bench(change), held);
    expect(ready({ status: "ready", homing: { next_step: "link" } })).toMatchObject({
      mayRun: false,
      before: "home",
    });
    expect(ready({ dead_man: true })).toMatchObject({ mayRun: false, before: "hold" });
    expect(ready({ dead_man: true }, true)).toMatchObject({ mayRun: true, before: null });
    expect(ready({ status: "fault" }).before).toBe("clear");
  });

  it("is nothing while it moves, or its loop does not tick", () => {
    expect(readinessOf(bench({ status: "run" }), false)).toEqual({
      mayBeSet: false,
      mayRun: false,
      before: null,
    });
    expect(readinessOf(bench({ status: "ramp" }), false).before).toBe("ramping");
    const silent = readinessOf(bench({ loop: { state: "silent" } }), false);
    expect(silent).toMatchObject({ mayBeSet: false, mayRun: false });
  });
});

describe("a step on a bench", () => {
  it("is there where the exercise says so, and has what is asked there", () => {
    expect(isDoneHere(of(null), bench())).toBe(false);
    expect(isDoneHere(of(null), null)).toBe(true);
    expect(isDoneHere(HUNG, bench())).toBe(true);
    expect(askedOf(HUNG, bench())).toEqual(["on a bench"]);
    expect(askedOf(HUNG, null)).toEqual(["simulated"]);
  });

  it("tells what is to be done by hand, until a moment after", () => {
    expect(handDue(HUNG, 0)?.time_s).toBe(5);
    expect(handDue(HUNG, 6.9)?.time_s).toBe(5);
    expect(handDue(HUNG, 7)?.is_on).toBe(false);
    expect(handDue(HUNG, 11)).toBeNull();
    expect(handDue(of(null), 0)).toBeNull();
  });

  it("is cut off where control is lost or the bench is stopped, and not before it runs", () => {
    expect(findCut(state({}), true)).toBeNull();
    expect(findCut(state({}), false)).toBe("control");
    expect(findCut(state({ bench: null }), false)).toBe("control");
    expect(findCut(state({ bench: bench({ status: "ramp" }) }), true)).toBe("stopped");
    expect(findCut(state({ bench: bench(), time_s: 0 }), true)).toBeNull();
    expect(findCut(state({ bench: bench({ status: "fault" }) }), true)).toBeNull();
  });
});
