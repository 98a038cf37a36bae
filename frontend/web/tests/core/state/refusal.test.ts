import "../../browserless";
import { describe, expect, it } from "vitest";
import { RefusedError, type Violation } from "../../../src/core/api/errors";
import type { Kinds } from "../../../src/core/api/types";
import { FIELDS, quantityOf } from "../../../src/core/quantities";
import { effectQuantityOf, kinds } from "../../../src/core/state/kinds";
import { explainRefusal, explainViolation } from "../../../src/core/state/refusal";

const violation = (change: Partial<Violation>): Violation => ({
  name: "frequency_hz",
  value: null,
  unit: "",
  bound: "given",
  limits: {},
  finding: "",
  message: "as the server says",
  ...change,
});

const row = { symbol: "", kind: "number", default: 0, low: 0 } as const;
const LAG: Kinds = {
  figures: [],
  faults: [],
  presets: [],
  loads: [],
  position: [],
  stiffness: [],
  effects: [
    {
      name: "current_lag",
      meaning: "Lag of the current loop",
      value: null,
      parameters: [
        { ...row, name: "time_constant_s", meaning: "Time constant", unit: "s", high: 0.05 },
      ],
    },
    {
      name: "delay_samples",
      meaning: "Delay of the torque",
      value: { ...row, name: "delay_samples", meaning: "Delay", unit: "samples", high: 5 },
      parameters: [],
    },
  ],
};

describe("a rejection on the page", () => {
  it("has the name and the unit of the field that the user edited", () => {
    const amplitude = violation({
      name: "amplitude_rad",
      value: (9999 * Math.PI) / 180,
      bound: "at most 6.28319 rad",
      limits: { le: 2 * Math.PI },
    });
    expect(explainViolation(amplitude)).toBe(
      "Amplitude: 9999 deg is out of range (at most 360 deg). The value is unchanged.",
    );
    kinds.value = LAG;
    const lag = violation({
      name: "current_lag.time_constant_s",
      value: 0.2,
      limits: { le: 0.05 },
    });
    expect(explainViolation(lag)).toContain(
      "Time constant: 200 ms is out of range (at most 50 ms)",
    );
    const stiffness = violation({ name: "stiffness", value: 151, limits: { ge: 1.7, le: 150.56 } });
    expect(explainViolation(stiffness)).toContain(
      "151 N·m/rad is out of range (from 1.7 to 150.56 N·m/rad)",
    );
  });

  it("distinguishes fields with the same name", () => {
    const names = (path: string) => quantityOf(path)?.label;
    expect(names("bandwidth_rad_per_s[2]")).toContain("Motor 2");
    expect(names("actuator.link_inertia_kg_m2")).toBe("M link inertia, True");
    expect(names("nominal.link_inertia_kg_m2")).toBe("M link inertia, Model");
    kinds.value = LAG;
    expect(effectQuantityOf("current_lag.time_constant_s")?.label).toBe("Time constant");
    expect(effectQuantityOf("delay_samples")?.unit).toBe("samples");
    expect(effectQuantityOf("noise.time_constant_s")).toBeNull();
  });

  it("names poles instead of coefficients", () => {
    const gains = violation({
      name: "position_coefficients",
      value: [1, 2, 3, 4],
      bound: "Hurwitz",
      finding: "24.4 ± 24.4j lies right of the imaginary axis",
    });
    expect(explainViolation(gains)).toBe(
      "Position poles: 24.4 ± 24.4j lies right of the imaginary axis.",
    );
  });

  it("is named as the field that was edited, by the end of its path", () => {
    const own = { label: "ω 2", unit: "rad/s" };
    const message = (name: string) => {
      const excess = violation({ name, value: 5000, limits: { le: 100 } });
      return explainRefusal(new RefusedError(422, "as the server says", [excess]), "rate[1]", own);
    };
    const named = "ω 2: 5000 rad/s is out of range (at most 100 rad/s). The value is unchanged.";
    expect(message("lqi.rate[1]")).toBe(named);
    expect(message("comparisons[0].parameters.rate[1]")).toBe(named);
    expect(message("lqi.other_rate[1]")).toBe("as the server says");
  });

  it("is the text of the server if the page has no name for the field", () => {
    expect(explainViolation(violation({ name: "comparisons[0].law" }))).toBe("as the server says");
    expect(quantityOf("toString")).toBeNull();
  });

  it("has a display name for every field", () => {
    for (const [name, { title = "" }] of Object.entries(FIELDS)) {
      expect(title, name).not.toContain("_");
      expect(title.length, name).toBeGreaterThan(2);
    }
  });
});
