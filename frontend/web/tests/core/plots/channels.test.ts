import "../../browserless";
import { describe, expect, it } from "vitest";
import type { SessionState } from "../../../src/core/api/types";
import { boundsOf } from "../../../src/core/plots/channels";
import type { Trace } from "../../../src/core/plots/definitions";

const trace = (channel: string, colour: string) => ({ channel, colour, lane: 1 }) as Trace;

const limited = (torque1_nm: number, torque2_nm: number, antagonistic = false) =>
  ({
    actuator: { antagonistic },
    configuration: { limits: { torque1_nm, torque2_nm } },
  }) as SessionState;

describe("the limits of the torques", () => {
  const traces = [trace("torque1_nm", "blue"), trace("torque2_nm", "ochre")];

  it("have a line and a label each if they differ", () => {
    expect(boundsOf(traces, limited(15, 6))).toEqual([
      { label: "limit u₁", value: 15, colour: "blue" },
      { label: "limit u₂", value: 6, colour: "ochre" },
    ]);
  });

  it("have one line and one label if they are the same", () => {
    expect(boundsOf(traces, limited(6, 6))).toEqual([
      { label: "limit u₁, u₂", value: 6, colour: "reference" },
    ]);
  });

  it("are the sum of both antagonistic motors", () => {
    expect(boundsOf(traces, limited(6, 5, true))).toEqual([
      { label: "limit u₁, u₂", value: 11, colour: "reference" },
    ]);
  });
});
