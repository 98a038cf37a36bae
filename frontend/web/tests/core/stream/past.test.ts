import { describe, expect, it } from "vitest";
import type { Batch } from "../../../src/core/stream/decoder";
import { SampleRing } from "../../../src/core/stream/ring";

const PERIOD_S = 0.001;
const NAMES = ["position_rad", "velocity_rad_per_s"];

/** Samples whose values are their ticks, negative in lane 2. */
function batch(firstTick: number, count: number, stride = 5, names = NAMES): Batch {
  const rows = Array.from({ length: count }, (_, row) => firstTick + row * stride);
  const values = rows.flatMap((tick) => [1, -1].flatMap((sign) => names.map(() => sign * tick)));
  return {
    run: 1,
    firstTick,
    stride,
    count,
    missed: 0,
    lanes: [7, 9],
    values: new Float32Array(values),
  };
}

function ticksOf(ring: SampleRing, name = NAMES[0] as string, lane = 1): number[] {
  return Array.from({ length: ring.length }, (_, index) => ring.valueAt(name, index, lane));
}

const range = (from: number, to: number, step = 5) =>
  Array.from({ length: (to - from) / step }, (_, index) => from + index * step);

describe("the past after the first samples", () => {
  it("is inserted before them, its newest part first, while new samples arrive", () => {
    const ring = new SampleRing(1000, NAMES, [7, 9]);
    ring.append(batch(1000, 4), PERIOD_S);
    ring.insert(batch(900, 20), PERIOD_S);
    ring.append(batch(1020, 4, 10), PERIOD_S);
    const drawn = ring.changesOfPast;
    ring.insert(batch(800, 20), PERIOD_S);
    expect(ring.changesOfPast, "a plot draws all of it again").toBeGreaterThan(drawn);
    const expected = [...range(800, 1020), ...range(1020, 1060, 10)];
    expect(ticksOf(ring)).toEqual(expected);
    expect(ticksOf(ring, NAMES[1], 2)).toEqual(expected.map((tick) => -tick));
    expect(ring.timeAt(0)).toBe(800 * PERIOD_S);
    ring.append(batch(1060, 1), PERIOD_S);
    expect(ticksOf(ring), "no gap after the newest sample").toEqual([...expected, 1060]);
  });

  it("fills the gap to stored samples and replaces those of the same time", () => {
    const ring = new SampleRing(1000, ["position_rad"], [7, 9]);
    ring.append(batch(0, 100, 5, ["position_rad"]), PERIOD_S);
    const extended = ring.withChannels(NAMES);
    extended.append(batch(700, 4), PERIOD_S);
    extended.insert(batch(450, 50), PERIOD_S);
    extended.insert(batch(200, 50), PERIOD_S);
    expect(ticksOf(extended)).toEqual(range(0, 720));
    const velocities = ticksOf(extended, NAMES[1]);
    expect(velocities.slice(0, 40).every(Number.isNaN)).toBe(true);
    expect(velocities.slice(40)).toEqual(range(200, 720));
  });

  it("keeps the newest samples of a full ring", () => {
    const ring = new SampleRing(30, NAMES, [7, 9]);
    ring.append(batch(1000, 20), PERIOD_S);
    ring.insert(batch(900, 20), PERIOD_S);
    expect(ticksOf(ring)).toEqual(range(950, 1100));
  });

  it("arrives in the frozen copy, too, also part by part", () => {
    const ring = new SampleRing(1000, ["position_rad"], [7, 9]);
    ring.append(batch(0, 100, 5, ["position_rad"]), PERIOD_S);
    const frozen = ring.copy();
    const extended = ring.withChannels(NAMES);
    extended.insert(batch(400, 20), PERIOD_S);
    frozen.completeFrom(extended);
    extended.insert(batch(300, 20), PERIOD_S);
    frozen.completeFrom(extended);
    expect(ticksOf(frozen, NAMES[1]).slice(60)).toEqual(range(300, 500));
  });

  it("completes a frozen copy of the first samples, and fills its gap, but adds no newer ones", () => {
    const ring = new SampleRing(1000, NAMES, [7, 9]);
    ring.append(batch(300, 4), PERIOD_S);
    ring.append(batch(400, 4), PERIOD_S);
    const [frozen, drawn] = [ring.copy(), ring.changesOfPast];
    ring.insert(batch(320, 16), PERIOD_S);
    ring.append(batch(420, 4), PERIOD_S);
    frozen.completeFrom(ring);
    ring.insert(batch(100, 40), PERIOD_S);
    frozen.completeFrom(ring);
    expect(ticksOf(frozen)).toEqual(range(100, 420));
    expect(ticksOf(frozen, NAMES[1], 2)).toEqual(range(100, 420).map((tick) => -tick));
    expect(frozen.changesOfPast, "a plot draws all of it again").toBeGreaterThan(drawn);
  });
});
