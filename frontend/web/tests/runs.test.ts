import { beforeAll, describe, expect, it, vi } from "vitest";
import type { RunDetails } from "../src/api/types";
import type { readPlace as ReadPlace, writePlace as WritePlace } from "../src/runs/place";

const details = (change: object) =>
  ({
    configuration: { law: "ndobc", rivals: [], loads: [] },
    commands: [],
    lanes: ["lane1"],
    plant: "simulated",
    period_s: 0.001,
    first_tick: 0,
    ticks: 10_000,
    ...change,
  }) as unknown as RunDetails;
const given = (tick: number, kind: string, argument: unknown) => ({
  tick,
  command: { tick, kind, argument },
});

let readPlace: typeof ReadPlace;
let writePlace: typeof WritePlace;
let findOnset: (run: RunDetails) => number | null;
let overlayInk: (index: number) => { colour: string; dash: readonly number[] };
let drawSpark: typeof import("../src/runs/spark").drawSpark;

beforeAll(async () => {
  vi.stubGlobal("location", { search: "", pathname: "/", href: "http://lab/" });
  vi.stubGlobal("document", {
    baseURI: "http://lab/",
    hidden: false,
    documentElement: { dataset: {} },
    addEventListener: () => undefined,
  });
  vi.stubGlobal("window", {
    matchMedia: () => ({ matches: false, addEventListener: () => undefined }),
    addEventListener: () => undefined,
  });
  ({ readPlace, writePlace } = await import("../src/runs/place"));
  ({ findOnset } = await import("../src/runs/onset"));
  ({ overlayInk } = await import("../src/runs/overlaid"));
  ({ drawSpark } = await import("../src/runs/spark"));
});

describe("a place in the address", () => {
  it("is read as it was written", () => {
    for (const query of ["", "?runs=all", "?run=a-1&t=12.3", "?run=a-1", "?overlay=a,b"]) {
      expect(writePlace(readPlace(query), query)).toBe(query);
    }
  });

  it("keeps what else the address says", () => {
    expect(writePlace({ kind: "list" }, "?session=private-1&run=a&t=2")).toBe(
      "?session=private-1&runs=all",
    );
  });

  it("takes no moment that is none", () => {
    for (const query of ["?run=a&t=soon", "?run=a&t=-1"]) {
      expect(readPlace(query)).toEqual({ kind: "run", run: "a", timeS: 0 });
    }
  });
});

describe("the onset of the load", () => {
  it("is that of the first load, planned or given", () => {
    const planned = { configuration: { loads: [{ kind: "paper", start_s: 5 }] } };
    expect(findOnset(details(planned))).toBe(5);
    const early = given(2000, "load", { kind: "paper", start_s: null });
    expect(findOnset(details({ ...planned, commands: [early] }))).toBe(2);
    const later = given(2000, "load", { kind: "paper", start_s: 3 });
    expect(findOnset(details({ commands: [later] }))).toBe(3);
  });

  it("is none where the record holds none", () => {
    expect(findOnset(details({}))).toBeNull();
    const before = given(2000, "load", { kind: "paper", start_s: null });
    expect(findOnset(details({ first_tick: 4000, commands: [before] }))).toBeNull();
  });
});

describe("curves", () => {
  it("of an overlay share colour and dash with no other", () => {
    const inks = Array.from({ length: 20 }, (_, index) => overlayInk(index));
    expect(new Set(inks.map((ink) => `${ink.colour} ${ink.dash.join()}`)).size).toBe(20);
  });

  it("of a small plot are interrupted where a value is missing", () => {
    const lanes = { lane1: { position_error_rad: [0, null, -0.1, 0.05] } };
    const spark = drawSpark({ time_s: [0, 1, 2, 3], lanes });
    expect(spark.peak).toBe(0.1);
    expect(spark.paths[0]?.match(/M/g)).toHaveLength(2);
  });
});
