import { describe, expect, it } from "vitest";
import { mayHaveSamples } from "../../../src/core/plots/spans";
import type { Batch } from "../../../src/core/stream/decoder";
import { SampleRing } from "../../../src/core/stream/ring";

/** Samples at the ticks given, 5 apart; channel a is the tick, channel b its negative. */
function batch(firstTick: number, count: number): Batch {
  const ticks = Array.from({ length: count }, (_, row) => firstTick + 5 * row);
  const values = new Float32Array(ticks.flatMap((tick) => [tick, -tick]));
  return { run: 1, firstTick, stride: 5, count, missed: 0, lanes: [1], values };
}

function contents(ring: SampleRing, first = 0, factor = 1) {
  const time = new Float64Array(ring.length);
  const a = new Float32Array(ring.length);
  const b = new Float32Array(ring.length);
  const count = ring.copyTime(first, time);
  ring.copyChannel("a", first, a, factor);
  ring.copyChannel("b", first, b, factor);
  return {
    time: [...time.subarray(0, count)],
    a: [...a.subarray(0, count)],
    b: [...b.subarray(0, count)],
  };
}

describe("SampleRing", () => {
  it("shows a span while samples arrive, and not where no sample arrived", () => {
    const ring = new SampleRing(20, ["a", "b"], [1]);
    ring.append(batch(0, 2), 0.001);
    expect(mayHaveSamples(ring, { from: 1, to: 2 })).toBe(true);
    ring.append(batch(3000, 2), 0.001);
    expect(mayHaveSamples(ring, { from: 1, to: 2 })).toBe(false);
    expect(mayHaveSamples(ring, { from: 2.5, to: 3.002 })).toBe(true);
  });

  it("returns the appended samples, with time computed from the ticks", () => {
    const ring = new SampleRing(10, ["a", "b"], [1]);
    ring.append(batch(1000, 3), 0.5);
    expect(contents(ring)).toEqual({
      time: [500, 502.5, 505],
      a: [1000, 1005, 1010],
      b: [-1000, -1005, -1010],
    });
    expect(ring.newestTime).toBe(505);
    expect(ring.newest("b")).toBe(-1010);
  });

  it("discards the oldest samples, and stays in order at its end", () => {
    const ring = new SampleRing(4, ["a", "b"], [1]);
    ring.append(batch(0, 3), 1);
    ring.append(batch(15, 3), 1);
    expect(contents(ring).a).toEqual([10, 15, 20, 25]);
    expect(contents(ring, 2).time).toEqual([20, 25]);
  });

  it("keeps the newest part of a batch larger than itself", () => {
    const ring = new SampleRing(4, ["a", "b"], [1]);
    ring.append(batch(0, 9), 1);
    expect(contents(ring).a).toEqual([25, 30, 35, 40]);
  });

  it("finds the first sample at or after a time", () => {
    const ring = new SampleRing(4, ["a", "b"], [1]);
    ring.append(batch(0, 6), 1);
    expect(ring.lowerBound(-1)).toBe(0);
    expect(ring.lowerBound(15)).toBe(1);
    expect(ring.lowerBound(15.5)).toBe(2);
    expect(ring.lowerBound(99)).toBe(4);
  });

  it("scales the values that it returns", () => {
    const ring = new SampleRing(4, ["a", "b"], [1]);
    ring.append(batch(10, 1), 1);
    expect(contents(ring, 0, 0.5).a).toEqual([5]);
  });

  it("is empty at first and after clearing", () => {
    const ring = new SampleRing(4, ["a", "b"], [1]);
    expect(ring.newestTime).toBeNaN();
    ring.append(batch(0, 2), 1);
    ring.clear();
    expect(ring.length).toBe(0);
    expect(ring.newest("a")).toBeNaN();
  });

  it("returns NaN for a channel that is not streamed", () => {
    const ring = new SampleRing(4, ["a", "b"], [1]);
    ring.append(batch(0, 2), 1);
    const out = new Float32Array(2);
    ring.copyChannel("c", 0, out);
    expect([...out]).toEqual([Number.NaN, Number.NaN]);
  });
});

/** Channel a of these lanes, by their ids, at one tick. */
const tick = (at: number, values: Record<number, number>): Batch => ({
  ...{ run: 1, firstTick: at, stride: 1, count: 1, missed: 0 },
  lanes: Object.keys(values).map(Number),
  values: new Float32Array(Object.values(values)),
});

function lane(ring: SampleRing, number: number): number[] {
  const out = new Float32Array(ring.length);
  ring.copyChannel("a", 0, out, 1, number);
  return [...out];
}

describe("the lanes of a SampleRing", () => {
  it("start without a past, and are removed with their samples", () => {
    const ring = new SampleRing(10, ["a"], [1]);
    ring.append(tick(0, { 1: 1 }), 1);
    ring.setLanes([1, 2]);
    ring.append(tick(1, { 1: 2, 2: 20 }), 1);
    ring.append(tick(2, { 1: 3, 2: 30 }), 1);
    expect(ring.lanes).toBe(2);
    expect(lane(ring, 1)).toEqual([1, 2, 3]);
    expect(lane(ring, 2)).toEqual([Number.NaN, 20, 30]);
    expect(ring.newest("a", 2)).toBe(30);
    ring.setLanes([1]);
    ring.append(tick(3, { 1: 4 }), 1);
    ring.setLanes([1, 3]);
    ring.append(tick(4, { 1: 5, 3: 50 }), 1);
    expect(lane(ring, 1)).toEqual([1, 2, 3, 4, 5]);
    expect(lane(ring, 2)).toEqual([Number.NaN, Number.NaN, Number.NaN, Number.NaN, 50]);
  });

  it("keep their own past if a lane between them is removed", () => {
    const ring = new SampleRing(10, ["a"], [1, 2, 3]);
    ring.append(tick(0, { 1: 1, 2: 20, 3: 300 }), 1);
    ring.setLanes([1, 3]);
    expect(lane(ring, 2)).toEqual([300]);
    ring.append(tick(1, { 1: 2, 3: 301 }), 1);
    expect(ring.lanes).toBe(2);
    expect([lane(ring, 1), lane(ring, 2)]).toEqual([
      [1, 2],
      [300, 301],
    ]);
    expect(ring.segment("a", 2, 0, 2)?.values.slice(0, 2)).toEqual(new Float32Array([300, 301]));
  });

  it("are identified by the batch if it was sent before lanes changed", () => {
    const ring = new SampleRing(10, ["a"], [1, 2, 3]);
    ring.setLanes([1, 3, 4]);
    ring.append(tick(0, { 1: 1, 2: 20, 3: 300 }), 1);
    expect([1, 2, 3].map((number) => lane(ring, number))).toEqual([[1], [300], [Number.NaN]]);
  });

  it("of a copy take missing channels from the same lane of the other ring", () => {
    const ring = new SampleRing(10, ["b"], [1, 2, 3]);
    ring.append(tick(0, { 1: 1, 2: 2, 3: 3 }), 1);
    const held = ring.copy();
    const next = ring.withChannels(["a"]);
    next.setLanes([1, 3]);
    next.append(tick(0, { 1: 10, 3: 30 }), 1);
    held.completeFrom(next);
    expect([1, 2, 3].map((number) => lane(held, number))).toEqual([[10], [Number.NaN], [30]]);
  });

  it("return NaN if they do not exist", () => {
    const ring = new SampleRing(10, ["a"], [1]);
    ring.append(tick(0, { 1: 1 }), 1);
    expect(lane(ring, 3)).toEqual([Number.NaN]);
    expect(ring.newest("a", 3)).toBeNaN();
  });
});

describe("missed samples", () => {
  const row = (firstTick: number, stride: number, ...values: number[]): Batch => ({
    ...{ run: 1, firstTick, stride, count: values.length, missed: 0, lanes: [1] },
    values: new Float32Array(values),
  });
  const rows = (ring: SampleRing) =>
    Array.from({ length: ring.length }, (_, index) => [
      ring.timeAt(index),
      ring.valueAt("a", index),
    ]);

  it("are a gap from the first to the last of them", () => {
    const ring = new SampleRing(20, ["a"], [1]);
    ring.append(row(0, 5, 1, 2), 1);
    ring.append(row(30, 5, 3, 4), 1);
    expect(rows(ring)).toEqual([
      [0, 1],
      [5, 2],
      [10, Number.NaN],
      [25, Number.NaN],
      [30, 3],
      [35, 4],
    ]);
    for (const time of [9, 17, 18, 26]) expect(ring.valueAt("a", ring.nearestTo(time))).toBeNaN();
  });

  it("are a gap if a single one is missing, and no gap if the rate changes", () => {
    const ring = new SampleRing(20, ["a"], [1]);
    ring.append(row(0, 50, 1, 2), 1);
    ring.append(row(100, 5, 3), 1);
    ring.append(row(105, 50, 4), 1);
    ring.append(row(160, 5, 5), 1);
    expect(rows(ring).map(([, value]) => value)).toEqual([1, 2, 3, 4, Number.NaN, 5]);
  });

  it("are filled in if the server sends them again", () => {
    const ring = new SampleRing(20, ["a"], [1]);
    ring.append(row(0, 5, 1, 2), 1);
    ring.append(row(20, 5, 5), 1);
    const next = ring.withChannels(["a"]);
    next.append(row(10, 5, 3, 4, 5), 1);
    expect(rows(next).map(([, value]) => value)).toEqual([1, 2, 3, 4, 5]);
  });
});

describe("a SampleRing whose channels change", () => {
  const one = (tick: number, ...values: number[]): Batch => ({
    ...{ run: 1, firstTick: tick, stride: 1, count: values.length, missed: 0, lanes: [1] },
    values: new Float32Array(values),
  });
  const values = (ring: SampleRing, channel: string) =>
    Array.from({ length: ring.length }, (_, index) => ring.valueAt(channel, index));

  it("keeps the past of unchanged channels, and accepts samples that are sent again", () => {
    const ring = new SampleRing(10, ["a"], [1]);
    ring.append(one(0, 1, 2, 3, 4), 1);
    const next = ring.withChannels(["b", "a"]);
    next.append({ ...one(2, 30, 3, 40, 4, 50, 5), count: 3 }, 1);
    expect(values(next, "a")).toEqual([1, 2, 3, 4, 5]);
    expect(values(next, "b")).toEqual([Number.NaN, Number.NaN, 30, 40, 50]);
    expect(values(ring, "a")).toEqual([1, 2, 3, 4]);
  });

  it("adds missing channels to a copy, matched by time", () => {
    const ring = new SampleRing(10, ["a"], [1]);
    ring.append(one(0, 1, 2, 3), 1);
    const held = ring.copy();
    const next = ring.withChannels(["b"]);
    next.append(one(1, 20, 30, 40), 1);
    held.completeFrom(next);
    expect(held.channels).toEqual(["a", "b"]);
    expect(values(held, "a")).toEqual([1, 2, 3]);
    expect(values(held, "b")).toEqual([Number.NaN, 20, 30]);
  });

  it("finds the nearest sample, whose number is stable while older ones are discarded", () => {
    const ring = new SampleRing(3, ["a"], [1]);
    ring.append(one(0, 0, 10, 20), 1);
    expect([-5, 0.4, 0.6, 9].map((time) => ring.nearestTo(time))).toEqual([0, 0, 1, 2]);
    expect(ring.segment("a", 1, 2, 3)?.number).toBe(2);
    ring.append(one(3, 30), 1);
    expect(ring.segment("a", 1, 1, 3)?.number).toBe(2);
    expect(ring.segment("b", 1, 0, 3)).toBeNull();
    expect(new SampleRing(3, []).nearestTo(1)).toBe(-1);
  });
});

describe("a reading", () => {
  it("is that of the nearest sample, and missing outside the record", () => {
    const ring = new SampleRing(10, ["a"], [1]);
    ring.append(batch(1000, 3), 0.01);
    const times = [9.9, 9.99, 10.04, 10.1, 10.11, 10.2];
    expect(times.map((time) => ring.sampleAt(time))).toEqual([-1, 0, 1, 2, 2, -1]);
    expect(new SampleRing(3, []).sampleAt(0)).toBe(-1);
  });

  it("of a channel added later starts at its first number", () => {
    const ring = new SampleRing(10, ["a"], [1]);
    ring.append(tick(0, { 1: 1 }), 1);
    ring.setLanes([1, 2]);
    ring.append(tick(1, { 1: 2, 2: 20 }), 1);
    expect(ring.firstTimeOf("a", 1)).toBe(0);
    expect(ring.firstTimeOf("a", 2)).toBe(1);
    expect(ring.firstTimeOf("b", 1)).toBeNaN();
  });
});
