import "../../browserless";
import { beforeEach, describe, expect, it } from "vitest";
import type { LawRow } from "../../../src/core/api/types";
import { lineStyleAt, lineStyleOf, shareLineStyles } from "../../../src/core/plots/linestyles";

const colours = (own: readonly (number | null)[]) =>
  shareLineStyles(own).map(({ colour }) => colour);

describe("inks that curves share out", () => {
  it("are each its own where no two have the same colour", () => {
    expect(shareLineStyles([8, 0, 6, 12])).toEqual([8, 0, 6, 12].map(lineStyleOf));
  });

  it("are as the server gives them to lanes: the first free colour where the own one is taken", () => {
    expect(shareLineStyles([0, 5])).toEqual([lineStyleOf(0), lineStyleOf(1)]);
    expect(shareLineStyles([0, 5, 1])).toEqual([lineStyleOf(0), lineStyleOf(2), lineStyleOf(1)]);
  });

  it("do not depend on the order in which the laws were chosen", () => {
    expect(shareLineStyles([5, 0])).toEqual([lineStyleOf(1), lineStyleOf(0)]);
    expect(new Set(colours([3, 8, 13]))).toEqual(new Set(colours([13, 3, 8])));
    expect(colours([8, 3])[1]).toBe(lineStyleOf(3).colour);
  });

  it("are all different, in colour while there are colours", () => {
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

  it("leave to those that have a line style their own", () => {
    expect(shareLineStyles([null, 0])).toEqual([lineStyleOf(1), lineStyleOf(0)]);
  });
});

it("the line style at a time is that of who controlled the lane then", () => {
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

  it("in the radar of the Ranking, whichever is chosen last", async () => {
    const { chosen, lineStyles } = await import("../../../src/evaluation/ranking/ranking");
    for (const names of [
      ["adrc", "pd", "ndobc"],
      ["ndobc", "pd", "adrc"],
    ]) {
      chosen.value = names;
      expect(lineStyles.value.get("ndobc")).toEqual(lineStyleOf(0));
      expect(lineStyles.value.get("adrc")).toEqual(lineStyleOf(2));
      expect(lineStyles.value.get("fl")).toBeUndefined();
    }
  });

  it("in a study, wherever it stands there", async () => {
    const { study } = await import("../../../src/evaluation/studies/studies");
    const { lawLineStyles } = await import("../../../src/evaluation/studies/shown");
    study.value = { laws: ["pd", "ndobc"] } as typeof study.value;
    expect(lawLineStyles.value).toEqual([lineStyleOf(3), lineStyleOf(0)]);
    study.value = null;
  });

  it("and what is installed nowhere one that no other has", async () => {
    const { lineStylesOfLaws } = await import("../../../src/core/plots/linestyles");
    expect(lineStylesOfLaws(["theirs", "ndobc"])).toEqual([lineStyleOf(1), lineStyleOf(0)]);
  });
});
