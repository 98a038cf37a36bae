import { afterEach, beforeEach, expect, it, vi } from "vitest";
import "../../browserless";
import type { Region, StartOutcome } from "../../../src/core/api/design";

const FIRSTS = [0, 48, 96];
/** One of the three initial states of each part comes to rest. */
const OUTCOMES = ["rest", "fault", "fault"].map((outcome) => ({
  outcome,
})) as unknown as StartOutcome[];
const asked: { first: number; count: number }[] = [];
let answer: (first: number) => Promise<Region>;

beforeEach(() => {
  asked.length = 0;
  answer = async (first) => {
    const next = FIRSTS[FIRSTS.indexOf(first) + 1] ?? null;
    return { outcomes: OUTCOMES, next } as unknown as Region;
  };
  vi.doMock("../../../src/core/api/design", () => ({
    requestRegion: (wanted: { first: number; count: number }) => {
      asked.push(wanted);
      return answer(wanted.first);
    },
  }));
});

afterEach(() => vi.doUnmock("../../../src/core/api/design"));

it("a map is requested part by part, until it is complete", async () => {
  const {
    outcomes,
    computeRegion: fillRegion,
    isComputing: isFilling,
    restShare: share,
    shownRegion: shown,
  } = await import("../../../src/lab/design/region");
  const filled = fillRegion("ndobc", "rigid", 10);
  expect([isFilling.value, share.value]).toEqual([true, null]);
  await filled;
  expect(asked.map(({ first, count }) => [first, count])).toEqual(FIRSTS.map((one) => [one, 48]));
  expect(outcomes.value).toHaveLength(9);
  expect(share.value).toBeCloseTo(1 / 3);
  expect(shown.value?.next, "it is of what was answered first").toBe(48);
  expect(isFilling.value).toBe(false);
});

it("a closed map requests no further part and ignores a later answer", async () => {
  const {
    outcomes,
    computeRegion: fillRegion,
    isComputing: isFilling,
    stopComputing: stopFilling,
  } = await import("../../../src/lab/design/region");
  let give = (_: Region) => {};
  answer = () =>
    new Promise((resolve) => {
      give = resolve;
    });
  const filled = fillRegion("ndobc", "rigid", 10);
  stopFilling();
  give({ outcomes: OUTCOMES, next: 48 } as unknown as Region);
  await filled;
  expect([asked.length, outcomes.value.length, isFilling.value]).toEqual([1, 0, false]);
});

it("reports why the map cannot be computed", async () => {
  const {
    computeRegion: fillRegion,
    isComputing: isFilling,
    problem,
  } = await import("../../../src/lab/design/region");
  answer = () => Promise.reject(new Error("Too busy."));
  await fillRegion("ndobc", "rigid", 10);
  expect(problem.value).toEqual(new Error("Too busy."));
  expect(isFilling.value).toBe(false);
});
