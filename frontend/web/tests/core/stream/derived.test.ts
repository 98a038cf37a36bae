import { describe, expect, it } from "vitest";
import type { Batch } from "../../../src/core/stream/decoder";
import { SampleRing, sourcesOf } from "../../../src/core/stream/ring";

describe("a derived channel", () => {
  const VELOCITIES = ["velocity_reference_rad_per_s", "velocity_rad_per_s"];
  const of = (tick: number, ...values: number[]): Batch => ({
    ...{ run: 1, firstTick: tick, stride: 1, count: 1, missed: 0, lanes: [1] },
    values: new Float32Array(values),
  });
  const derived = (ring: SampleRing) =>
    Array.from({ length: ring.length }, (_, index) =>
      ring.valueAt("velocity_error_rad_per_s", index),
    );

  it("is the difference of two channels, sample by sample, and is not streamed", () => {
    const ring = new SampleRing(10, VELOCITIES, [1]);
    ring.append(of(0, 3, 1), 1);
    ring.append(of(2, 1, 4), 1);
    expect(derived(ring)).toEqual([2, Number.NaN, -3]);
    expect(ring.channels).toEqual(VELOCITIES);
    expect(sourcesOf("velocity_error_rad_per_s")).toEqual(VELOCITIES);
    expect(sourcesOf("torque1_nm")).toEqual(["torque1_nm"]);
  });

  it("is available if both channels are", () => {
    const ring = new SampleRing(10, VELOCITIES.slice(0, 1), [1]);
    ring.append(of(0, 3), 1);
    const held = ring.copy();
    const both = ring.withChannels(VELOCITIES);
    both.append(of(0, 3, 1), 1);
    expect(derived(both)).toEqual([2]);
    held.completeFrom(both);
    expect(derived(held)).toEqual([2]);
    expect(derived(both.withChannels(VELOCITIES.slice(0, 1)))).toEqual([Number.NaN]);
  });
});
