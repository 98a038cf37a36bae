import { describe, expect, it } from "vitest";
import type { Batch } from "../../../src/core/stream/decoder";
import { sourcesOf } from "../../../src/core/stream/derived";
import { SampleRing } from "../../../src/core/stream/ring";

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

  it("is an edge of the band of the stiffness estimate, and a gap while the estimator is off", () => {
    const names = ["stiffness_estimate_nm_per_rad", "stiffness_deviation_nm_per_rad"];
    const ring = new SampleRing(10, names, [1]);
    ring.append(of(0, 40, 0.5), 1);
    ring.append(of(1, 0, 0), 1);
    const read = (edge: string) => [0, 1].map((index) => ring.valueAt(edge, index));
    expect(read("stiffness_upper_nm_per_rad")[0]).toBeCloseTo(40.98, 5);
    expect(read("stiffness_lower_nm_per_rad")[0]).toBeCloseTo(39.02, 5);
    expect(read("stiffness_lower_nm_per_rad")[1]).toBeNaN();
    expect(sourcesOf("stiffness_upper_nm_per_rad")).toEqual(names);
  });
});
