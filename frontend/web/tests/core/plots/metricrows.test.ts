import { describe, expect, it } from "vitest";
import type { Metrics } from "../../../src/core/api/types";
import { listGroups, type MeasuredLane, readCell } from "../../../src/core/plots/metricrows";
import { t } from "../../../src/core/text/t";

const METRICS = {
  duration_s: 4,
  rms_position_error_rad: 0.01,
  peak_position_error_rad: 0.1,
  steady_state_position_error_rad: 0.001,
  integral_position_error_rad_s: 0.02,
  recovery_time_s: 0.25,
  rise_time_s: null,
  overshoot_share: null,
  settling_time_s: null,
  rms_stiffness_error_nm_per_rad: 0.2,
  peak_stiffness_error_nm_per_rad: 1.5,
  peak_stiffness_error_share: 0.1,
  steady_state_stiffness_error_nm_per_rad: 0.02,
  integral_stiffness_error_nms_per_rad: 0.4,
  stiffness_recovery_time_s: null,
  stiffness_rise_time_s: null,
  stiffness_overshoot_share: null,
  stiffness_settling_time_s: null,
  rms_torque1_nm: 0.5,
  rms_torque2_nm: 0.1,
  peak_torque1_nm: 15,
  peak_torque2_nm: 2,
  effort_n2m2_s: 1.25,
  work_j: 0.75,
  torque1_variation_nm_per_s: 8.5,
  torque2_variation_nm_per_s: 2.25,
  torque1_noise_nm: null,
  torque2_noise_nm: null,
} satisfies Metrics;

const lane = (changes: Partial<Metrics> = {}, isDisturbed = true): MeasuredLane => ({
  key: "1",
  look: {} as MeasuredLane["look"],
  name: "NDOBC",
  metrics: { ...METRICS, ...changes },
  isDisturbed,
});

/** The values of a lane in every group, by the names of its rows. */
function show(one: MeasuredLane) {
  const groups = listGroups([one]).map(({ name, rows }) => {
    const cells = rows.map((row) => [row.name, readCell(row, one)] as const);
    return [name, Object.fromEntries(cells)] as const;
  });
  return Object.fromEntries(groups);
}

describe("the metrics of a lane", () => {
  it("are grouped, in the displayed units", () => {
    const { Position, Stiffness, Effort } = show(lane());
    expect(Position?.["rms error"]).toEqual({ value: "0.573" });
    expect(Position?.IAE).toEqual({ value: "1.15" });
    expect(Position?.["Recovery time"]).toEqual({ value: "0.250" });
    expect(Stiffness?.["Peak deviation, relative"]).toEqual({ value: "10.0" });
    expect(Effort?.["Peak torque"]).toEqual({ value: "15.0 / 2.00" });
    expect(Effort?.["Mechanical work"]).toEqual({ value: "0.750" });
  });

  it("include a step response only after a step", () => {
    expect(Object.keys(show(lane()).Position ?? {})).not.toContain("Overshoot");
    const { Position, Stiffness } = show(lane({ rise_time_s: 0.3, overshoot_share: 0.163 }));
    expect(Position?.["Rise time"]).toEqual({ value: "0.300" });
    expect(Position?.Overshoot).toEqual({ value: "16.3" });
    expect(Position?.["Settling time"]?.hint).toBe(t("metrics.undefined.unsettled"));
    expect(Object.keys(Stiffness ?? {})).not.toContain("Overshoot");
  });

  it.each([
    ["Recovery time", lane({}, false), "undisturbed"],
    ["Recovery time", lane({ recovery_time_s: null }), "outside"],
    ["Steady-state error", lane({ steady_state_position_error_rad: null }), "loadEnded"],
    [
      "Steady-state error",
      lane({ steady_state_position_error_rad: null, duration_s: 0.9 }),
      "tooShort",
    ],
  ] as const)("say why there is no %s", (name, one, reason) => {
    expect(show(one).Position?.[name]).toEqual({
      value: "–",
      hint: t(`metrics.undefined.${reason}`),
    });
  });

  it("report an error that grew again as not recovered, and a stiffness that did not change", () => {
    const lost = show(lane({ steady_state_position_error_rad: 0.05 }));
    expect(lost.Position?.["Recovery time"]?.value).toBe("–");
    const { Stiffness, Effort } = show(lane({ peak_stiffness_error_nm_per_rad: 0.009 }));
    expect(Stiffness?.["Recovery time"]?.hint).toBe(t("metrics.undefined.unmoved"));
    expect(Effort?.["Torque noise at rest"]?.hint).toBe(t("metrics.undefined.moving"));
    const ideal = show(
      lane({ rms_position_error_rad: 1e-15, torque1_noise_nm: 0, torque2_noise_nm: 0 }),
    );
    expect(ideal.Position?.["rms error"]?.value).toBe("< 10⁻⁶");
    const ended = show({ ...lane(), metrics: null });
    expect(ended.Effort?.["Mechanical work"]?.hint).toBe(t("metrics.undefined.lane"));
  });
});
