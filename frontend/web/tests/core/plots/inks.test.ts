import "../../browserless";
import { beforeEach, describe, expect, it } from "vitest";
import type { LawRow } from "../../../src/core/api/types";
import { inkAt, inkOf, shareInks } from "../../../src/core/plots/inks";

const colours = (own: readonly (number | null)[]) => shareInks(own).map(({ colour }) => colour);

describe("inks that curves share out", () => {
  it("are each its own where no two have the same colour", () => {
    expect(shareInks([8, 0, 6, 12])).toEqual([8, 0, 6, 12].map(inkOf));
  });

  it("are as the server gives them to lanes: the first free colour where the own one is taken", () => {
    expect(shareInks([0, 5])).toEqual([inkOf(0), inkOf(1)]);
    expect(shareInks([0, 5, 1])).toEqual([inkOf(0), inkOf(2), inkOf(1)]);
  });

  it("do not depend on the order in which the laws were chosen", () => {
    expect(shareInks([5, 0])).toEqual([inkOf(1), inkOf(0)]);
    expect(new Set(colours([3, 8, 13]))).toEqual(new Set(colours([13, 3, 8])));
    expect(colours([8, 3])[1]).toBe(inkOf(3).colour);
  });

  it("are all different, in colour while there are colours", () => {
    for (const own of [
      [0, 0, 0, 0, 0],
      [null, null, null],
      [4, 9, 14, 19, null],
    ]) {
      expect(new Set(colours(own)).size, String(own)).toBe(own.length);
    }
    const looks = shareInks(Array.from({ length: 20 }, (_, index) => (7 * index) % 10));
    expect(new Set(looks.map(({ colour, dash }) => `${colour} ${dash.join()}`)).size).toBe(20);
  });

  it("leave to those that have an ink their own", () => {
    expect(shareInks([null, 0])).toEqual([inkOf(1), inkOf(0)]);
  });
});

it("the ink at a time is that of who controlled the lane then", () => {
  const lane = [
    { ink: 0, start_s: 0 },
    { ink: 3, start_s: 2 },
  ];
  expect([inkAt(lane, 1), inkAt(lane, 2), inkAt(undefined, 1)]).toEqual([0, 3, null]);
});

describe("a law has one ink", () => {
  beforeEach(async () => {
    const { laws } = await import("../../../src/core/state/laws");
    laws.value = ["ndobc", "fl", "adrc", "pd"].map((name, ink) => ({ name, ink }) as LawRow);
  });

  it("in the radar of the Ranking, whichever is chosen last", async () => {
    const { chosen, inks } = await import("../../../src/evaluation/ranking/ranking");
    for (const names of [
      ["adrc", "pd", "ndobc"],
      ["ndobc", "pd", "adrc"],
    ]) {
      chosen.value = names;
      expect(inks.value.get("ndobc")).toEqual(inkOf(0));
      expect(inks.value.get("adrc")).toEqual(inkOf(2));
      expect(inks.value.get("fl")).toBeUndefined();
    }
  });

  it("in a study, wherever it stands there", async () => {
    const { study } = await import("../../../src/evaluation/studies/studies");
    const { lawInks } = await import("../../../src/evaluation/studies/shown");
    study.value = { laws: ["pd", "ndobc"] } as typeof study.value;
    expect(lawInks.value).toEqual([inkOf(3), inkOf(0)]);
    study.value = null;
  });

  it("and what is installed nowhere one that no other has", async () => {
    const { inksOfLaws } = await import("../../../src/core/plots/lawinks");
    expect(inksOfLaws(["theirs", "ndobc"])).toEqual([inkOf(1), inkOf(0)]);
  });
});
