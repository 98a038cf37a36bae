import "../../browserless";
import { beforeAll, describe, expect, it, vi } from "vitest";
import type { RunDetails } from "../../../src/core/api/types";
import { lineStyleOf } from "../../../src/core/plots/linestyles";
import type {
  readPlace as ReadPlace,
  writePlace as WritePlace,
} from "../../../src/runs/list/place";

const details = (change: object) =>
  ({
    configuration: { law: "ndobc", comparisons: [], loads: [] },
    commands: [],
    lanes: ["lane1"],
    plant: "simulated",
    period_s: 0.001,
    first_tick: 0,
    ticks: 10_000,
    segments: [],
    ...change,
  }) as unknown as RunDetails;
let readPlace: typeof ReadPlace;
let writePlace: typeof WritePlace;
let describeDegrees: typeof import("../../../src/runs/list/columns").describeDegrees;
let describeMeasured: typeof import("../../../src/runs/list/measured").describeMeasured;
let explainSteadyState: typeof import("../../../src/runs/list/measured").explainSteadyState;
let overlay: typeof import("../../../src/runs/list/overlaycurves").overlay;
let nameWindow: typeof import("../../../src/runs/list/overlaycurves").nameWindow;
let explainDifference: typeof import("../../../src/runs/list/overlaycurves").explainDifference;
let drawSpark: typeof import("../../../src/runs/list/sparkline").drawSpark;
let findWords: typeof import("../../../src/runs/list/highlight").findWords;
let excerpt: typeof import("../../../src/runs/list/highlight").excerpt;
let formatSetting: typeof import("../../../src/runs/list/differencetable").formatSetting;
let nextSort: typeof import("../../../src/core/widgets/tables").nextSort;
let followSaving: typeof import("../../../src/runs/list/saved").followSaving;
let saveStatus: typeof import("../../../src/runs/list/saved").saveStatus;

beforeAll(async () => {
  ({ readPlace, writePlace } = await import("../../../src/runs/list/place"));
  ({ describeMeasured, explainSteadyState } = await import("../../../src/runs/list/measured"));
  ({ describeDegrees } = await import("../../../src/runs/list/columns"));
  ({ nameWindow, overlay } = await import("../../../src/runs/list/overlaycurves"));
  ({ explainDifference } = await import("../../../src/runs/list/overlaycurves"));
  ({ drawSpark } = await import("../../../src/runs/list/sparkline"));
  ({ findWords, excerpt } = await import("../../../src/runs/list/highlight"));
  ({ formatSetting } = await import("../../../src/runs/list/differencetable"));
  ({ nextSort } = await import("../../../src/core/widgets/tables"));
  ({ followSaving, saveStatus } = await import("../../../src/runs/list/saved"));
});

describe("a place in the address", () => {
  it("is read back as it was written", () => {
    for (const query of ["", "?runs=all", "?run=a-1&t=12.3", "?run=a-1", "?overlay=a,b"]) {
      expect(writePlace(readPlace(query), query)).toBe(query);
    }
  });

  it("opens an exercise at a step", () => {
    for (const query of ["?learn=all", "?learn=observer", "?learn=observer/rig"]) {
      expect(writePlace(readPlace(query), query)).toBe(query);
    }
    expect(readPlace("?learn=observer/rig&session=x")).toEqual({
      kind: "learn",
      exercise: "observer",
      step: "rig",
    });
    expect(readPlace("?learn=all")).toEqual({ kind: "learn", exercise: "", step: "" });
  });

  it("of a study contains axes, law and brush", () => {
    const query = "?studies=load&sx=a&ty=b&law=fl&brush=s%3A1,2,3,4";
    const look = { sx: "a", ty: "b", law: "fl", brush: "s:1,2,3,4" };
    expect(readPlace(query)).toEqual({ kind: "studies", study: "load", look });
    expect(writePlace(readPlace(query), query)).toBe(query);
    expect(writePlace({ kind: "studies", study: "", look: {} }, query)).toBe("?studies=all");
    expect(writePlace({ kind: "ranking" }, query)).toBe("?ranking=all");
  });

  it("keeps the other parts of the address", () => {
    expect(writePlace({ kind: "list" }, "?session=private-1&run=a&t=2")).toBe(
      "?session=private-1&runs=all",
    );
  });

  it("ignores an invalid time", () => {
    for (const query of ["?run=a&t=soon", "?run=a&t=-1"]) {
      expect(readPlace(query)).toEqual({ kind: "run", run: "a", timeS: 0 });
    }
  });
});

describe("the window of the metrics of a run", () => {
  const window = {
    ...{ kind: "load", label: "3 kg load", first_tick: 2000, end_tick: 5000 },
    ...{ start_s: 2, end_s: 5, is_whole: false, lanes: ["FL"], load_ended: false },
  } as const;
  const samples = { time_s: [2, 5], lanes: {} } as never;

  it("is named with its ends, and with the law if others controlled before or after", () => {
    const measured = { ...window, lanes: [...window.lanes] };
    expect(describeMeasured(measured)).toBe("3 kg load, 2.00–5.00 s");
    expect(describeMeasured(measured, true)).toBe("FL: 3 kg load, 2.00–5.00 s");
    expect(describeMeasured({ ...measured, is_whole: true })).toBe("Whole run");
    expect(describeMeasured({ ...measured, label: "" })).toBe("From the start, 2.00–5.00 s");
  });

  it("has the value of every lane by its law, for a narrow table", () => {
    const metrics = [{ peak_position_error_rad: 0.0628 }, { peak_position_error_rad: 0.195 }];
    const run = details({ window: { ...window, lanes: ["NDOBC", "FL"] }, metrics });
    expect(describeDegrees(run, "peak_position_error_rad")).toBe("NDOBC 3.6°, FL 11°");
    expect(describeDegrees(details({ window: null, metrics }), "peak_position_error_rad")).toBe(
      undefined,
    );
  });

  it("has a steady-state error if its load remains and it is long enough", () => {
    const measured = { ...window, lanes: [] };
    expect(explainSteadyState(measured)).toMatch(/last 0.5 s/);
    expect(explainSteadyState({ ...measured, load_ended: true })).toMatch(/the load ended before/);
    expect(explainSteadyState({ ...measured, end_s: 2.9 })).toMatch(/shorter than 1 s/);
  });

  it("starts at 0 in an overlay, which states its end and its laws", () => {
    const run = details({ title: "A", lane_names: ["NDOBC → FL"], window, metrics: [{}] });
    const segments = [
      [
        { line_style: 0, start_s: 0 },
        { line_style: 1, start_s: 1.5 },
      ],
    ];
    const [curve] = overlay({ ...run, segments } as never, samples);
    expect(curve?.ownLineStyle).toBe(1);
    expect(curve).toMatchObject({ startsWithLoad: true, changedS: 3, measuredLane: "FL" });
    expect([...(curve?.time ?? [])]).toEqual([0, 3]);
    const whole = { ...window, kind: "start", end_tick: 10_000, end_s: 10 };
    const later = overlay(details({ ...run, first_tick: 1500, ticks: 8500 }), samples);
    expect(later[0]?.window).toMatchObject({ start_s: 0.5, end_s: 3.5 });
    const [other] = overlay(details({ ...run, window: whole }), samples);
    expect(other).toMatchObject({ startsWithLoad: false, changedS: null });
    const removal = { ...window, kind: "unload", label: "3 kg load off" };
    const [removed] = overlay(details({ ...run, window: removal }), samples);
    // The run had a load: it was removed.
    expect(nameWindow(removed as never)).toBe("from 3 kg load off");
    expect(explainDifference([curve, other] as never, null)).toMatch(/start with different events/);
    expect(explainDifference([curve, curve] as never, null)).toBe("");
  });
});

describe("curves", () => {
  it("of an overlay have a unique colour and dash", () => {
    const lineStyles = Array.from({ length: 20 }, (_, index) => lineStyleOf(index));
    expect(
      new Set(lineStyles.map((lineStyle) => `${lineStyle.colour} ${lineStyle.dash.join()}`)).size,
    ).toBe(20);
  });

  it("of a small plot have a gap at missing values", () => {
    const lanes = { lane1: { position_error_rad: [0, null, -0.1, 0.05] } };
    const ndobc = {
      number: 1,
      name: "NDOBC",
      line_style: 0,
      has_estimate: true,
      start_tick: 0,
      start_s: 0,
      end_tick: null,
    };
    const spark = drawSpark({ time_s: [0, 1, 2, 3], lanes }, [[{ ...ndobc, end_s: null }]]);
    expect(spark.peak).toBe(0.1);
    expect(spark.paths[0]?.path.match(/M/g)).toHaveLength(2);
    const fl = { ...ndobc, number: 2, name: "FL", line_style: 1, start_s: 2, end_s: null };
    const switched = drawSpark({ time_s: [0, 1, 2, 3], lanes }, [[{ ...ndobc, end_s: 2 }, fl]]);
    expect(switched.paths.map(({ lineStyle }) => lineStyle)).toEqual([0, 1]);
    expect(switched.paths[1]?.path).toMatch(/^M200\.0 /);
  });
});

describe("a match of a search", () => {
  const shown = (text: string, words: string[]) =>
    findWords(text, words).map(({ text: part, isFound }) => (isFound ? `[${part}]` : part));

  it("is marked at its position, in any case", () => {
    expect(shown("Student 07", ["07", "stud"])).toEqual(["[Stud]", "ent ", "[07]"]);
    expect(shown("aaa", ["aa"])).toEqual(["[aaa]"]);
    expect(shown("100 %", ["%"])).toEqual(["100 ", "[%]"]);
  });

  it("is the complete text without a search or if case folding moves its letters", () => {
    expect(shown("Fig. 4A", [])).toEqual(["Fig. 4A"]);
    expect(shown("U\u0308bung", ["übung"])).toEqual(["U\u0308bung"]);
    expect(shown("", ["a"])).toEqual([]);
  });

  it("is visible in a long note", () => {
    const note = `${"before ".repeat(20)}heavy load`;
    expect(excerpt(note, ["heavy"])).toBe("…e before before heavy load".slice(-27));
    expect(excerpt(note, ["nowhere"])).toBe(note);
  });
});

describe("a setting that differs", () => {
  it("is shown in the displayed units", () => {
    const angle = { group: "Motion", name: "Amplitude", unit: "rad", values: [Math.PI / 3, null] };
    expect(formatSetting(angle)).toEqual({ unit: "deg", values: ["60", "–"] });
    const others = { group: "Realism", name: "x", unit: "N·m", values: [-0.25, "on", true] };
    expect(formatSetting(others)).toEqual({ unit: "N·m", values: ["−0.25", "on", "yes"] });
  });
});

describe("the order of the table", () => {
  it("is reversed by the second click on a column", () => {
    expect(nextSort("-created", "name", false)).toBe("name");
    expect(nextSort("name", "name", false)).toBe("-name");
    expect(nextSort("name", "peak_position_error_rad", true)).toBe("-peak_position_error_rad");
    expect(nextSort("-peak_position_error_rad", "peak_position_error_rad", true)).toBe(
      "peak_position_error_rad",
    );
  });
});

describe("a recording that has ended", () => {
  it("is saved when its file is complete, and unknown without an answer", async () => {
    vi.useFakeTimers();
    const answers = [{ state: "recording" }, { state: "complete", title: "Fig. 4A" }];
    vi.stubGlobal("fetch", async () => Response.json(answers.shift()));
    const done = followSaving("run-1");
    expect(saveStatus.value).toEqual({ stage: "saving", run: "run-1" });
    await vi.advanceTimersByTimeAsync(1000);
    await done;
    expect(saveStatus.value).toMatchObject({ stage: "saved", details: { title: "Fig. 4A" } });
    await vi.advanceTimersByTimeAsync(15_000);
    expect(saveStatus.value).not.toBeNull();
    await vi.advanceTimersByTimeAsync(6000);
    expect(saveStatus.value, "it does not stay indefinitely").toBeNull();
    vi.stubGlobal("fetch", async () => Response.json({ state: "cut", message: "cut off" }));
    await followSaving("run-3");
    await vi.advanceTimersByTimeAsync(60_000);
    expect(saveStatus.value, "what is not whole stays until it was seen").not.toBeNull();
    vi.stubGlobal("fetch", () => Promise.reject(new TypeError("offline")));
    const lost = followSaving("run-2", 1000);
    await vi.advanceTimersByTimeAsync(5000);
    await lost;
    expect(saveStatus.value).toEqual({ stage: "unknown", run: "run-2" });
    vi.useRealTimers();
  });
});
