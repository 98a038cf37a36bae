import { describe, expect, test } from "vitest";
import { caveatOf, rangeOf } from "../../../src/lab/design/words";

const RANGE = { parameter: "link_inertia_kg_m2", symbol: "M", present: 0.67 };

describe("curves of a loop that is unstable", () => {
  test("a loop that is stable on the rig needs no text", () => {
    expect(caveatOf({ largest_pole: 0.97, encoders: "rig" })).toBeNull();
  });

  test("a loop that is unstable on the rig is reported with its largest pole", () => {
    const caveat = caveatOf({ largest_pole: 1.0312, encoders: "rig" });
    expect(caveat?.short).toBe("unstable on the rig");
    expect(caveat?.summary).toContain("|z| = 1.0312");
    expect(caveat?.summary).toContain("without the rig's quantization and delay");
  });

  test("a session with its own encoders is reported by its own loop, also at the boundary", () => {
    const caveat = caveatOf({ largest_pole: 1, encoders: "session" });
    expect(caveat?.short).toContain("unstable: no steady state");
    expect(caveat?.summary).not.toContain("rig");
  });
});

describe("the permitted error of a parameter", () => {
  test("has both bounds, one, or none", () => {
    expect(rangeOf({ ...RANGE, low: 0.2317, high: 3.844 })).toBe("0.23 – 3.84");
    expect(rangeOf({ ...RANGE, low: null, high: 4.39 })).toBe("up to 4.39");
    expect(rangeOf({ ...RANGE, low: 0.25, high: null })).toBe("from 0.25");
    expect(rangeOf({ ...RANGE, low: null, high: null })).toBe("all");
  });
});
