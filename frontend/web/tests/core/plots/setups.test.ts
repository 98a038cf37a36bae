import "../../browserless";
import { describe, expect, it } from "vitest";
import { placeTicks } from "../../../src/core/plots/axes";
import { CHANNELS_BY_UNIT } from "../../../src/core/plots/channels";
import { readPiece, samplesOf } from "../../../src/core/plots/definitions";
import { shareColours } from "../../../src/core/plots/linestyles";
import { readSetups } from "../../../src/core/plots/setups";
import { drawSvg } from "../../../src/core/plots/svg";
import { composeContent, hasOneValue, tracesOf } from "../../../src/core/plots/traces";
import type { LaneSegments, Segment } from "../../../src/core/state/lanes";
import { SampleRing } from "../../../src/core/stream/ring";

describe("the plots stored in the browser", () => {
  it("are restored", () => {
    const stored = JSON.stringify([
      { preset: "torque", channels: ["torque2_nm"] },
      { preset: "own", channels: ["velocity_rad_per_s"] },
    ]);
    expect(readSetups(stored)).toEqual([
      { key: "torque", preset: "torque", channels: ["torque2_nm"] },
      { key: "own1", preset: "own", channels: ["velocity_rad_per_s"] },
    ]);
  });

  it("keep the chosen axes of the phase plane, by default velocity error over error", () => {
    const stored = JSON.stringify([
      { preset: "phase", channels: ["torque1_nm", "deflection_rad"] },
    ]);
    expect(readSetups(stored)?.[0]?.channels).toEqual(["torque1_nm", "deflection_rad"]);
    const odd = JSON.stringify([{ preset: "phase", channels: ["torque1_nm"] }]);
    const atFirst = ["position_error_rad", "velocity_error_rad_per_s"];
    expect(readSetups(odd)?.[0]?.channels).toEqual(atFirst);
  });

  it("are restored as far as they are valid", () => {
    expect(readSetups(null)).toBeNull();
    expect(readSetups("{")).toBeNull();
    expect(readSetups('"position"')).toBeNull();
    const odd = [
      { preset: "no such plot", channels: ["no such channel"] },
      { preset: "toString" },
      { preset: "error", channels: ["position_error_rad", "torque1_nm", 7] },
      null,
    ];
    expect(readSetups(JSON.stringify(odd))).toEqual([
      { key: "error", preset: "error", channels: ["position_error_rad"] },
    ]);
  });
});

const segment = (
  number: number,
  name: string,
  from = 0,
  to = Number.POSITIVE_INFINITY,
): Segment => {
  return { number, name, lineStyle: number - 1, hasEstimate: name !== "FL", from, to };
};
/** Unchanged lanes. */
const castOf = (...names: string[]): LaneSegments =>
  names.map((name, index) => [segment(index + 1, name)]);

describe("the curves after an exchange of laws", () => {
  const swapped: LaneSegments = [
    [segment(1, "NDOBC", 0, 7), segment(2, "FL", 7)],
    [segment(2, "FL", 0, 7), segment(1, "NDOBC", 7)],
  ];
  const curves = (cast: LaneSegments) =>
    tracesOf(composeContent(["position_error_rad"], cast), new Set(["position_error_rad"]), 2);

  it("keep name and line style of the law that produced the samples", () => {
    const message = curves(swapped).map(({ lane, from, to, label, colour }) => {
      return { lane, from, to, label, colour };
    });
    const at = (lane: number, from: number) =>
      message.find((one) => one.lane === lane && one.from === from);
    expect(at(1, 0)).toEqual({ lane: 1, from: 0, to: 7, label: "NDOBC", colour: "blue" });
    expect(at(2, 0)).toEqual({ lane: 2, from: 0, to: 7, label: "FL", colour: "vermilion" });
    expect(at(1, 7)).toMatchObject({ label: "FL", colour: "vermilion" });
    expect(at(2, 7)).toMatchObject({ label: "NDOBC", colour: "blue" });
  });

  it("have one legend entry per law, which hides all their segments", () => {
    const entries = curves(swapped).filter(({ follows }) => follows === undefined);
    expect(entries.map(({ label }) => label)).toEqual(["FL", "NDOBC"]);
    for (const one of curves(swapped).filter(({ continues }) => continues)) {
      const owner = entries.find(({ key }) => key === one.follows);
      expect(owner).toMatchObject({ label: one.label, colour: one.colour, dash: one.dash });
    }
  });

  it("use only the samples of their segment", () => {
    const ring = new SampleRing(100, ["position_error_rad"], [1, 2]);
    const rows = Float32Array.from({ length: 20 }, (_, index) => index);
    ring.append(
      { run: 1, firstTick: 0, stride: 1000, missed: 0, lanes: [1, 2], count: 10, values: rows },
      0.001,
    );
    for (const one of curves(swapped)) {
      const { first, end } = samplesOf(ring, one, 0, 10);
      expect([first, end]).toEqual(one.from === 0 ? [0, 7] : [7, 10]);
      expect(readPiece(ring, one, 8)).toEqual(one.from === 0 ? Number.NaN : expect.any(Number));
    }
  });

  it("of a single lane have line styles and names of its laws too", () => {
    const alone: LaneSegments = [[segment(1, "NDOBC", 0, 7), segment(2, "FL", 7)]];
    const traces = tracesOf(composeContent(["position_error_rad"], alone), new Set(), 1);
    expect(traces.map(({ label, colour }) => [label, colour])).toEqual([
      ["FL", "vermilion"],
      ["NDOBC", "blue"],
    ]);
  });

  it("of a new lane start when the lane was added", () => {
    const cast: LaneSegments = [[segment(1, "NDOBC")], [segment(2, "FL", 7)]];
    expect(curves(cast).find(({ lane }) => lane === 2)?.from).toBe(7);
  });
});

describe("the curves of a plot", () => {
  const disturbance = ["estimate_link_nm", "estimate_motor1_nm", "disturbance_link_nm"] as const;

  it("have one value each, except the true disturbances, which differ between lanes", () => {
    const channels = ["estimate_link_nm", "disturbance_link_nm"] as const;
    const valued = (cast: LaneSegments) => {
      const all = tracesOf(composeContent(channels, cast), new Set(channels), cast.length);
      const entries = all.filter(({ follows }) => follows === undefined);
      return entries.filter(({ key }) => hasOneValue(all, key)).map(({ label }) => label);
    };
    const swapped = [segment(1, "NDOBC", 0, 7), segment(2, "FL", 7), segment(1, "NDOBC", 9)];
    expect(valued(castOf("NDOBC", "ADRC"))).toEqual(["NDOBC", "ADRC"]);
    expect(valued([swapped, [segment(3, "LQI")]])).toEqual(["NDOBC", "LQI"]);
    expect(valued([swapped])).toEqual(["NDOBC", "FL"]);
  });

  it("omit the estimate of a comparison law that does not use it, but not the true disturbance", () => {
    const channels = ["estimate_link_nm", "disturbance_link_nm"] as const;
    const drawn = (cast: LaneSegments) =>
      tracesOf(composeContent(channels, cast), new Set(channels), cast.length).map(
        ({ channel, lane }) => `${channel} ${lane}`,
      );
    const truths = ["disturbance_link_nm 1", "disturbance_link_nm 2"];
    expect(drawn(castOf("NDOBC", "FL"))).toEqual(["estimate_link_nm 1", ...truths]);
    expect(drawn(castOf("FL", "NDOBC"))).toEqual(["estimate_link_nm 2", ...truths]);
    const joined: LaneSegments = [
      [segment(1, "FL", 0, 7), segment(2, "NDOBC", 7)],
      [segment(3, "FL")],
    ];
    expect(drawn(joined)).toEqual(["estimate_link_nm 1", ...truths]);
  });

  it("have one colour per channel for one lane, the true value dashed in the colour of its estimate", () => {
    const traces = tracesOf(composeContent(disturbance, castOf("NDOBC")), new Set(), 1);
    const [link, truth, motor] = traces;
    expect(traces).toHaveLength(3);
    expect(truth?.colour).toBe(link?.colour);
    expect(truth?.dash).not.toEqual([]);
    expect(truth?.follows).toBe(link?.key);
    expect(motor?.colour).not.toBe(link?.colour);
  });

  it("have one line style per lane, and symbols distinguish the selected quantities", () => {
    const lanes = ["NDOBC", "FL"];
    const cast = castOf(...lanes);
    const content = composeContent(["torque1_nm", "torque2_nm"], cast);
    expect(tracesOf(content, new Set(["torque1_nm"]), 2).map(({ label }) => label)).toEqual(lanes);
    const both = tracesOf(content, new Set(["torque1_nm", "torque2_nm"]), 2);
    expect(new Set(both.map(({ label }) => label)).size).toBe(4);
    expect(both[0]?.colour).toBe(both[2]?.colour);
    expect(both[0]?.sign).not.toBe(both[2]?.sign);
  });

  it("are solid for the selected law, also while it was a comparison, and dashed for others", () => {
    const cast = [
      [segment(1, "NDOBC", 0, 7), segment(2, "FL", 7)],
      [segment(2, "FL", 0, 7), segment(1, "NDOBC", 7)],
    ];
    const traces = tracesOf(
      composeContent(["position_error_rad"], cast),
      new Set(["position_error_rad"]),
      2,
    );
    expect(traces.map(({ label, dash }) => [label, dash.length === 0])).toEqual([
      ["FL", true],
      ["NDOBC", false],
      ["NDOBC", false],
      ["FL", true],
    ]);
  });

  it("show a reference once, and a limit on both sides", () => {
    const position = composeContent(["position_rad", "position_reference_rad"], castOf("A", "B"));
    expect(position.common).toHaveLength(1);
    const deflection = composeContent(["deflection_rad", "deflection_limit_rad"], castOf("A"));
    const factors = tracesOf(deflection, new Set(), 1).map(({ factor }) => Math.sign(factor));
    expect(factors).toEqual([1, 1, -1]);
  });

  it("do not share a colour until all are in use", () => {
    const looks = shareColours(["blue", "blue", "blue", "green", "green", "blue"]);
    expect(new Set(looks.slice(0, 5).map(({ colour }) => colour)).size).toBe(5);
    expect(looks[5]?.dash).not.toEqual([]);
  });

  it("have one unit per plot, and every channel belongs to one unit", () => {
    const names = CHANNELS_BY_UNIT.flatMap(({ channels }) => channels);
    expect(new Set(names).size).toBe(names.length);
    expect(names).toHaveLength(36);
  });
});

describe("a plot as SVG", () => {
  it("has ticks at round numbers", () => {
    expect(placeTicks({ from: -1.2, to: 4.1 }, 5)).toEqual([0, 2, 4]);
  });

  it("has escaped texts and keeps its gaps", () => {
    const colours = new Proxy({}, { get: () => "#000" }) as Parameters<
      typeof drawSvg
    >[0]["colours"];
    const [trace] = tracesOf(composeContent(["position_error_rad"], castOf("A")), new Set(), 1);
    if (trace === undefined) throw new Error("there is no curve");
    const points = {
      x: new Float64Array([0, 1, 2, 3]),
      y: new Float64Array([0, Number.NaN, 1, 1]),
      count: 4,
    };
    const svg = drawSvg({
      title: "a < b & c",
      x: { label: "Time (s)", from: 0, to: 3 },
      y: { label: "deg", from: 0, to: 1 },
      curves: [{ trace, points }],
      bounds: [],
      events: [{ time: 1, label: '"on"' }],
      colours,
    });
    expect(svg).toContain("a &lt; b &amp; c");
    expect(svg).toContain("&quot;on&quot;");
    expect(svg).toMatch(/d="M74 368M651.33 62L940 62"/);
  });
});
