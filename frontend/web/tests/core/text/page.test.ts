import { describe, expect, it } from "vitest";
import { adviceOn } from "../../../src/core/text/page";

describe("what to try after a fault", () => {
  const values = { deflection_rad: 0.012, motor2_position_rad: 1.09 };

  it("is about the load and the gains where the motors gave what was asked for", () => {
    expect(adviceOn("lever_end", values)).toContain("stiffer setting");
    expect(adviceOn("quick_stop", {})).toBeNull();
  });

  it("is about heat where a motor was held back by it, whatever the fault is called", () => {
    const warm = { ...values, motor2_heat: 1, motor2_commanded_nm: 5, motor2_held_to_nm: 1.27 };
    for (const code of ["lever_end", "implausible"]) {
      expect(adviceOn(code, warm)).toContain("Let the motor cool");
      expect(adviceOn(code, warm)).not.toContain("stiffer setting");
    }
  });
});
