import "../../browserless";
import { beforeEach, describe, expect, it } from "vitest";
import type { LawRow } from "../../../src/core/api/types";
import {
  lineStyleAt,
  lineStyleOf,
  lineStyleOfLane,
  shareLineStyles,
} from "../../../src/core/plots/linestyles";
import css from "../../../src/theme.css?raw";

const colours = (own: readonly (number | null)[]) =>
  shareLineStyles(own).map(({ colour }) => colour);

describe("line styles of several curves", () => {
  it("are those of the laws if their colours differ", () => {
    expect(shareLineStyles([8, 0, 6, 12])).toEqual([8, 0, 6, 12].map(lineStyleOf));
  });

  it("have another colour if another law has the same one", () => {
    expect(shareLineStyles([0, 5])).toEqual([lineStyleOf(0), lineStyleOf(1)]);
    expect(shareLineStyles([0, 5, 1])).toEqual([lineStyleOf(0), lineStyleOf(2), lineStyleOf(1)]);
  });

  it("do not depend on the order in which the laws were chosen", () => {
    expect(shareLineStyles([5, 0])).toEqual([lineStyleOf(1), lineStyleOf(0)]);
    expect(new Set(colours([3, 8, 13]))).toEqual(new Set(colours([13, 3, 8])));
    expect(colours([8, 3])[1]).toBe(lineStyleOf(3).colour);
  });

  it("are all different, by colour while colours are available", () => {
    for (const own of [
      [0, 0, 0, 0, 0],
      [null, null, null],
      [4, 9, 14, 19, null],
    ]) {
      expect(new Set(colours(own)).size, String(own)).toBe(own.length);
    }
    const looks = shareLineStyles(Array.from({ length: 20 }, (_, index) => (7 * index) % 10));
    expect(new Set(looks.map(({ colour, dash }) => `${colour} ${dash.join()}`)).size).toBe(20);
  });

  it("use one colour for two lanes of a law next to other laws, with different dashes", () => {
    const [ndobc, one, other] = shareLineStyles([0, 1, 1]);
    expect([ndobc?.colour, one?.colour, other?.colour]).toEqual(["blue", "vermilion", "vermilion"]);
    expect(one?.dash).not.toEqual(other?.dash);
  });

  it("keep the line style of laws that have one", () => {
    expect(shareLineStyles([null, 0])).toEqual([lineStyleOf(1), lineStyleOf(0)]);
  });
});

it("only the selected controller is solid, and only references are dotted", () => {
  for (const lineStyle of Array.from({ length: 30 }, (_, index) => index)) {
    expect(lineStyleOfLane(lineStyle, true).dash).toEqual([]);
    for (const { dash } of [lineStyleOf(lineStyle), lineStyleOfLane(lineStyle, false)]) {
      expect(
        Math.min(Number.POSITIVE_INFINITY, ...dash.filter((_, at) => at % 2 === 0)),
      ).toBeGreaterThan(3);
    }
    expect(lineStyleOfLane(lineStyle, false).dash).not.toEqual([]);
  }
});

it("the line style at a time is that of the controller of the lane at that time", () => {
  const lane = [
    { line_style: 0, start_s: 0 },
    { line_style: 3, start_s: 2 },
  ];
  expect([lineStyleAt(lane, 1), lineStyleAt(lane, 2), lineStyleAt(undefined, 1)]).toEqual([
    0,
    3,
    null,
  ]);
});

describe("a law has one line style", () => {
  beforeEach(async () => {
    const { laws } = await import("../../../src/core/state/laws");
    laws.value = ["ndobc", "fl", "adrc", "pd"].map(
      (name, line_style) => ({ name, line_style }) as LawRow,
    );
  });

  it("in a study, at any position", async () => {
    const { study } = await import("../../../src/evaluation/studies/selection");
    const { lawLineStyles } = await import("../../../src/evaluation/studies/drawnrows");
    study.value = { laws: ["pd", "ndobc"] } as typeof study.value;
    expect(lawLineStyles.value).toEqual([lineStyleOf(3), lineStyleOf(0)]);
    study.value = null;
  });

  it("also if it is not installed, different from those of other laws", async () => {
    const { lineStylesOfLaws } = await import("../../../src/core/plots/linestyles");
    expect(lineStylesOfLaws(["theirs", "ndobc"])).toEqual([lineStyleOf(1), lineStyleOf(0)]);
  });
});

type Triple = [number, number, number];

/** Simulation of full color blindness on linear RGB (Machado, Oliveira and Fernandes 2009). */
const SIGHTS: Record<string, readonly Triple[]> = {
  "all cones": [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  "no green cones": [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  "no red cones": [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
};
const TO_XYZ: readonly Triple[] = [
  [0.4124, 0.3576, 0.1805],
  [0.2126, 0.7152, 0.0722],
  [0.0193, 0.1192, 0.9505],
];
const WHITE: Triple = [0.9505, 1, 1.089];

const times = (rows: readonly Triple[], [x, y, z]: Triple): Triple =>
  rows.map(([a, b, c]) => a * x + b * y + c * z) as Triple;
const linear = (hex: string): Triple =>
  [1, 3, 5].map((at) => {
    const share = Number.parseInt(hex.slice(at, at + 2), 16) / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  }) as Triple;
const luminance = (hex: string) => times(TO_XYZ, linear(hex))[1];

function contrast(one: string, other: string): number {
  const [dark, bright] = [luminance(one), luminance(other)].sort((a, b) => a - b) as Triple;
  return (bright + 0.05) / (dark + 0.05);
}

/** CIE L*a*b* of 1976. */
function toLab(rgb: Triple): Triple {
  const bounded = rgb.map((part) => Math.min(1, Math.max(0, part))) as Triple;
  const [x, y, z] = times(TO_XYZ, bounded).map((part, axis) => {
    const share = part / (WHITE[axis] as number);
    return share > 0.008856 ? Math.cbrt(share) : 7.787 * share + 16 / 116;
  }) as Triple;
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

function difference(sight: readonly Triple[], one: string, other: string): number {
  const [a, b] = [one, other].map((hex) => toLab(times(sight, linear(hex)))) as [Triple, Triple];
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

const NAMES = ["blue", "orange", "green", "vermilion", "purple"];
const themes = ["light", "dark"].map((theme, place) => {
  const read = (name: string) =>
    [...css.matchAll(new RegExp(`--${name}: (#[0-9a-f]{6})`, "g"))][place]?.[1] ?? "";
  return { theme, surface: read("surface"), lineStyles: NAMES.map((name) => read(`plot-${name}`)) };
});

describe.each(themes)("the line styles of curves, $theme", ({ surface, lineStyles }) => {
  it("have sufficient contrast with the page", () => {
    for (const lineStyle of lineStyles)
      expect(contrast(lineStyle, surface), lineStyle).toBeGreaterThan(3);
  });

  it.each(Object.keys(SIGHTS))("are distinguishable with %s without their dashes", (sight) => {
    for (const [at, one] of lineStyles.entries()) {
      for (const other of lineStyles.slice(at + 1)) {
        expect(difference(SIGHTS[sight] ?? [], one, other), `${one} ${other}`).toBeGreaterThan(14);
      }
    }
  });
});
