/** Every metric of a window of a run, as rows of a table. */
import type { Metrics } from "../api/types";
import { t } from "../text/t";
import { formatError, formatNumber, toDegrees } from "../units";
import type { LineStyle } from "./definitions";

export interface MeasuredLane {
  key: string;
  look: LineStyle;
  name: string;
  /** null if samples are missing. */
  metrics: Metrics | null;
  /** Whether a load was added or removed at the start of the window. */
  isDisturbed: boolean;
}

/** Formatted value; for an undefined metric the reason. */
interface Shown {
  value: string;
  hint?: string;
}

export interface MetricRow {
  name: string;
  hint: string;
  unit: string;
  read: (metrics: Metrics, isDisturbed: boolean) => Shown;
}

const RECOVERY_SHARE = 0.02;
/** A smaller stiffness error has no recovery time. */
const UNMOVED_NM_PER_RAD = 0.01;

/** The final error is outside the recovery band, for example because a load grows later. */
export const isLost = (steady: number | null, peak: number): boolean =>
  (steady ?? 0) > RECOVERY_SHARE * peak;

const SMALLEST = 1e-6;

/** A non-zero number is never shown as zero: without effects the loop leaves 10⁻¹⁵. */
const format = (value: number): string =>
  value !== 0 && Math.abs(value) < SMALLEST ? t("metrics.tiny") : formatError(value);

const number = (value: number): Shown => ({ value: format(value) });
const missing = (hint: string): Shown => ({ value: formatNumber(null), hint });
const orMissing = (value: number | null, hint: string): Shown =>
  value === null ? missing(hint) : number(value);
const both = (first: number | null, second: number | null): Shown =>
  first === null || second === null
    ? missing(t("metrics.undefined.moving"))
    : { value: `${format(first)} / ${format(second)}` };

/** Metrics that position and stiffness have in common; convert: to the unit on screen. */
interface Output {
  unit: string;
  integralUnit: string;
  convert: (value: number) => number;
  rms: (metrics: Metrics) => number;
  peak: (metrics: Metrics) => number;
  steady: (metrics: Metrics) => number | null;
  integral: (metrics: Metrics) => number;
  recovery: (metrics: Metrics) => number | null;
  rise: (metrics: Metrics) => number | null;
  overshoot: (metrics: Metrics) => number | null;
  settling: (metrics: Metrics) => number | null;
}

const POSITION: Output = {
  unit: t("metrics.units.degrees"),
  integralUnit: t("metrics.units.degreeSeconds"),
  convert: toDegrees,
  rms: (metrics) => metrics.rms_position_error_rad,
  peak: (metrics) => metrics.peak_position_error_rad,
  steady: (metrics) => metrics.steady_state_position_error_rad,
  integral: (metrics) => metrics.integral_position_error_rad_s,
  recovery: (metrics) => metrics.recovery_time_s,
  rise: (metrics) => metrics.rise_time_s,
  overshoot: (metrics) => metrics.overshoot_share,
  settling: (metrics) => metrics.settling_time_s,
};

const STIFFNESS: Output = {
  unit: t("metrics.units.stiffness"),
  integralUnit: t("metrics.units.stiffnessSeconds"),
  convert: (value) => value,
  rms: (metrics) => metrics.rms_stiffness_error_nm_per_rad,
  peak: (metrics) => metrics.peak_stiffness_error_nm_per_rad,
  steady: (metrics) => metrics.steady_state_stiffness_error_nm_per_rad,
  integral: (metrics) => metrics.integral_stiffness_error_nms_per_rad,
  recovery: (metrics) => metrics.stiffness_recovery_time_s,
  rise: (metrics) => metrics.stiffness_rise_time_s,
  overshoot: (metrics) => metrics.stiffness_overshoot_share,
  settling: (metrics) => metrics.stiffness_settling_time_s,
};

function showRecovery(of: Output, metrics: Metrics, isDisturbed: boolean): Shown {
  const seconds = of.recovery(metrics);
  if (!isDisturbed) return missing(t("metrics.undefined.undisturbed"));
  if (seconds === null) {
    const isUnmoved = of === STIFFNESS && of.peak(metrics) <= UNMOVED_NM_PER_RAD;
    return missing(isUnmoved ? t("metrics.undefined.unmoved") : t("metrics.undefined.outside"));
  }
  if (isLost(of.steady(metrics), of.peak(metrics))) {
    return missing(t("metrics.undefined.lost", { seconds: formatNumber(seconds, 3, 3) }));
  }
  return number(seconds);
}

const nameMetric = (
  key:
    | "effort"
    | "iae"
    | "noise"
    | "overshoot"
    | "peak"
    | "peakShare"
    | "peakTorque"
    | "recovery"
    | "rise"
    | "rms"
    | "rmsTorque"
    | "settling"
    | "steady"
    | "variation"
    | "work",
) => ({
  name: t(`metrics.${key}.name`),
  hint: t(`metrics.${key}.hint`),
});

/** The rows of the errors, and those of the step response if one of the lanes has one. */
function listOutput(of: Output, lanes: readonly MeasuredLane[]): MetricRow[] {
  const inUnit = (read: (metrics: Metrics) => number) => (metrics: Metrics) =>
    number(of.convert(read(metrics)));
  const hasStep = lanes.some(({ metrics }) => metrics !== null && of.rise(metrics) !== null);
  const steps: MetricRow[] = [
    {
      ...nameMetric("rise"),
      unit: t("metrics.units.seconds"),
      read: (metrics) => orMissing(of.rise(metrics), t("metrics.undefined.unreached")),
    },
    {
      ...nameMetric("overshoot"),
      unit: t("metrics.units.percent"),
      read: (metrics) => {
        const share = of.overshoot(metrics);
        return share === null ? missing(t("metrics.undefined.unreached")) : number(100 * share);
      },
    },
    {
      ...nameMetric("settling"),
      unit: t("metrics.units.seconds"),
      read: (metrics) => orMissing(of.settling(metrics), t("metrics.undefined.unsettled")),
    },
  ];
  return [
    { ...nameMetric("rms"), unit: of.unit, read: inUnit(of.rms) },
    { ...nameMetric("peak"), unit: of.unit, read: inUnit(of.peak) },
    ...(of === STIFFNESS
      ? [
          {
            ...nameMetric("peakShare"),
            unit: t("metrics.units.percent"),
            read: (metrics: Metrics) => number(100 * metrics.peak_stiffness_error_share),
          },
        ]
      : []),
    {
      ...nameMetric("steady"),
      unit: of.unit,
      read: (metrics) => {
        const steady = of.steady(metrics);
        const why =
          metrics.duration_s < 1
            ? t("metrics.undefined.tooShort")
            : t("metrics.undefined.loadEnded");
        return steady === null ? missing(why) : number(of.convert(steady));
      },
    },
    { ...nameMetric("iae"), unit: of.integralUnit, read: inUnit(of.integral) },
    {
      ...nameMetric("recovery"),
      unit: t("metrics.units.seconds"),
      read: (metrics, isDisturbed) => showRecovery(of, metrics, isDisturbed),
    },
    ...(hasStep ? steps : []),
  ];
}

const EFFORT: readonly MetricRow[] = [
  {
    ...nameMetric("rmsTorque"),
    unit: t("metrics.units.torque"),
    read: (metrics) => both(metrics.rms_torque1_nm, metrics.rms_torque2_nm),
  },
  {
    ...nameMetric("peakTorque"),
    unit: t("metrics.units.torque"),
    read: (metrics) => both(metrics.peak_torque1_nm, metrics.peak_torque2_nm),
  },
  {
    ...nameMetric("work"),
    unit: t("metrics.units.work"),
    read: (metrics) => number(metrics.work_j),
  },
  {
    ...nameMetric("effort"),
    unit: t("metrics.units.effort"),
    read: (metrics) => number(metrics.effort_n2m2_s),
  },
  {
    ...nameMetric("variation"),
    unit: t("metrics.units.variation"),
    read: (metrics) => both(metrics.torque1_variation_nm_per_s, metrics.torque2_variation_nm_per_s),
  },
  {
    ...nameMetric("noise"),
    unit: t("metrics.units.torque"),
    read: (metrics) => both(metrics.torque1_noise_nm, metrics.torque2_noise_nm),
  },
];

interface MetricGroup {
  name: string;
  remark: string;
  rows: readonly MetricRow[];
}

/** The rows by group. */
export const listGroups = (lanes: readonly MeasuredLane[]): MetricGroup[] => [
  { name: t("metrics.groups.position"), remark: "", rows: listOutput(POSITION, lanes) },
  { name: t("metrics.groups.stiffness"), remark: "", rows: listOutput(STIFFNESS, lanes) },
  { name: t("metrics.groups.effort"), remark: t("metrics.both"), rows: EFFORT },
];

/** Cell of a row for a lane. */
export const readCell = (row: MetricRow, { metrics, isDisturbed }: MeasuredLane): Shown =>
  metrics === null ? missing(t("metrics.undefined.lane")) : row.read(metrics, isDisturbed);
