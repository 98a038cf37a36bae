import { describe, expect, it, vi } from "vitest";
import type { RunDetails } from "../../../src/core/api/types";
import type { OverlayCurve } from "../../../src/runs/list/overlaycurves";
import { stubBrowser } from "../../browser";

stubBrowser();
vi.stubGlobal("document", { baseURI: "http://lab/", documentElement: { dataset: {} } });
vi.stubGlobal("location", { search: "" });
const { chooseAlignment, overlay } = await import("../../../src/runs/list/overlaycurves");
const { explainDifference } = await import("../../../src/runs/list/overlaycurves");
const { COLUMNS, findBest } = await import("../../../src/runs/list/overlaytable");

describe("overlaid runs", () => {
  const runOf = (change: object) =>
    ({
      ...{ lanes: ["lane1"], lane_names: ["FL"], segments: [], period_s: 0.001, first_tick: 0 },
      ...change,
    }) as never;
  const NAMED = { is_whole: false, lanes: ["FL"], load_ended: false };
  const loaded = { kind: "load", label: "3 kg load", first_tick: 5000, end_tick: 9000 };
  const LOADED = runOf({
    ...{ id: "a", ticks: 10_000, commands: [], configuration: { loads: [] } },
    window: { ...loaded, start_s: 5, end_s: 9, ...NAMED },
  });
  const ended = { kind: "start", label: "", first_tick: 0, end_tick: 100 };
  const ENDED = runOf({
    ...{ id: "b", ticks: 100, commands: [], configuration: { loads: [] } },
    window: { ...ended, start_s: 0, end_s: 0.1, ...NAMED },
  });
  const samples = (...time: number[]) => ({ time_s: time, lanes: {} }) as never;

  it("are aligned at their starts if a run ended before its load", () => {
    expect(chooseAlignment([LOADED, ENDED])).toBe("start");
    const [withLoad] = overlay(LOADED, samples(0, 5, 10), "start");
    const [without] = overlay(ENDED, samples(0, 0.1), "start");
    expect([...(withLoad?.time ?? [])]).toEqual([0, 5, 10]);
    expect([...(without?.time ?? [])]).toEqual([0, 0.1]);
    expect(withLoad).toMatchObject({ startS: 5, changedS: 9, alignment: "start", zeroS: 0 });
    expect(without).toMatchObject({ startS: 0, changedS: null });
  });

  it("are aligned at their loads if all have one, or if a record starts later than its run", () => {
    expect(chooseAlignment([LOADED, LOADED])).toBe("window");
    expect(chooseAlignment([ENDED, ENDED])).toBe("window");
    const later = runOf({ ...(ENDED as object), first_tick: 50 });
    expect(chooseAlignment([LOADED, later])).toBe("window");
    const [curve] = overlay(LOADED, samples(0, 5, 10), chooseAlignment([LOADED, LOADED]));
    expect([...(curve?.time ?? [])]).toEqual([-5, 0, 5]);
    expect(curve).toMatchObject({ startS: 0, changedS: 4, zeroS: 5 });
  });
});

describe("the best value of an overlay", () => {
  const PAPER = { tick: 2000, command: { kind: "load", argument: { kind: "paper" } } };
  const curveOf = (id: string, peak: number, change: object = {}) => {
    const window = { ...{ kind: "load", label: "3 kg load", first_tick: 2000, end_tick: 5000 } };
    const lane = { ...window, start_s: 2, end_s: 5, is_whole: false, lanes: ["FL"] };
    const of = {
      lanes: ["lane1"],
      plant: "simulated",
      period_s: 0.001,
      first_tick: 0,
      ticks: 5000,
      commands: [PAPER],
      command_count: 1,
      configuration: { loads: [] },
    };
    const metrics = [
      {
        ...{ rms_position_error_rad: peak / 4, peak_position_error_rad: peak },
        ...{
          steady_state_position_error_rad: peak / 9,
          recovery_time_s: null,
          peak_torque1_nm: peak,
        },
        rms_stiffness_error_nm_per_rad: peak,
      },
    ];
    const run = {
      id,
      lane_names: ["FL"],
      segments: [],
      window: lane,
      metrics,
      ...of,
      ...change,
    } as unknown as RunDetails;
    return overlay(run, { time_s: [], lanes: {} } as never)[0] as OverlayCurve;
  };
  const differing = (...rows: [string, string][]) =>
    ({ differences: rows.map(([group, name]) => ({ group, name })) }) as never;
  const marked = (curves: OverlayCurve[], isAlike = true) =>
    COLUMNS.filter((column) => findBest(curves, column, isAlike) === 0).map(({ name }) => name);

  it("is marked if runs differ in the controller only", () => {
    const pair = [curveOf("a", 0.07), curveOf("b", 0.2)];
    const controllers = differing(
      ["Controller", "Law"],
      ["Changed while it was recorded", "Gains"],
      ["Loads", "Loads"],
    );
    expect(explainDifference(pair, controllers)).toBe("");
    for (const group of ["Motion", "Stiffness", "Realism", "Plant", "Record"]) {
      expect(explainDifference(pair, differing([group, "x"]))).toBe(
        `other settings differ: ${group}`,
      );
    }
    const changed = differing(["Changed while it was recorded", "Motion"], ["Stiffness", "σ_d"]);
    expect(explainDifference(pair, changed)).toBe("other settings differ: Motion, Stiffness");
    expect(explainDifference(pair, null)).toMatch(/unknown/);
  });

  it("requires the same loads at the same time of the run, for any start of the recording", () => {
    const heavy = { ...PAPER, command: { kind: "load", argument: { kind: "mass", mass_kg: 5 } } };
    const same = curveOf("b", 0.2, { first_tick: 700 });
    expect(explainDifference([curveOf("a", 0.07), same], differing(["Loads", "Loads"]))).toBe("");
    const many = { command_count: 2000 };
    for (const change of [{ commands: [heavy] }, many, { commands: [{ ...PAPER, tick: 1999 }] }]) {
      const other = curveOf("b", 0.2, change);
      expect(explainDifference([curveOf("a", 0.07), other], differing())).toMatch(
        /^the loads or their times differ/,
      );
    }
  });

  it("is not marked between a bench and its twin, nor between a bench and a simulation", () => {
    const bench = curveOf("a", 0.07, { lanes: ["lane1", "lane2"], plant: "emulated" });
    const simulated = curveOf("b", 0.2);
    const why = "bench and simulation are different plants";
    expect(explainDifference([bench, { ...bench, plant: "simulated" }], differing())).toBe(why);
    expect(explainDifference([bench, simulated], differing(["Record", "Recorded on"]))).toBe(why);
    expect(explainDifference([bench, { ...bench, run: "c" }], differing())).toBe("");
  });

  it("is not marked for the smallest torque, nor for rms of windows of different length", () => {
    const [small, large] = [curveOf("a", 0.07), curveOf("b", 0.2)];
    const errors = ["Peak error", "Steady-state error"];
    expect(marked([small, large])).toEqual(["rms error", ...errors, "rms stiffness"]);
    expect(marked([small, large], false)).toEqual([]);
    const longer = { ...large, window: { ...large.window, end_tick: 5001 } } as OverlayCurve;
    expect(marked([small, longer])).toEqual(errors);
  });
});
