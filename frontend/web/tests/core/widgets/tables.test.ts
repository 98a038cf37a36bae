import { describe, expect, it } from "vitest";
import { bestOf } from "../../../src/core/widgets/tables";

describe("bestOf", () => {
  it.each([
    ["the clearly smallest", [3, 1, 2], 1],
    ["none of two that are nearly equal", [1, 1.02], -1],
    ["none of two that are nothing", [1e-9, 1e-12], -1],
    ["the only one that recovered", [0.8, Number.POSITIVE_INFINITY], 0],
    ["none where none recovered", [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY], -1],
    ["none where a value is missing", [1, null], -1],
  ])("finds %s", (_, values, best) => {
    expect(bestOf(values)).toBe(best);
  });
});
