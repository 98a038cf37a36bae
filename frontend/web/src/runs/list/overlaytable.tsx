import type { Metrics, RunDifference } from "../../core/api/types";
import { AllMetrics } from "../../core/plots/allmetrics";
import { type MetricsColumn, MetricsTable } from "../../core/plots/metricstable";
import { t } from "../../core/text/t";

import { formatError, formatNumber, toDegrees } from "../../core/units";
import { bestOf } from "../../core/widgets/tables";
import { describeMeasured, isDisturbed } from "./measured";
import { explainDifference, haveEqualLength, nameCurve, type OverlayCurve } from "./overlaycurves";

interface Column {
  name: string;
  unit: string;
  read: (metrics: Metrics) => number | null;
  /** Condition for marking the smallest value as the best among equal runs; null: not marked. */
  isBest: "always" | "in one length" | null;
}

export const COLUMNS: readonly Column[] = [
  {
    name: t("overlay.rmsError"),
    unit: t("overlay.degrees"),
    read: (metrics) => toDegrees(metrics.rms_position_error_rad),
    isBest: "in one length",
  },
  {
    name: t("overlay.peakError"),
    unit: t("overlay.degrees"),
    read: (metrics) => toDegrees(metrics.peak_position_error_rad),
    isBest: "always",
  },
  {
    name: t("overlay.steadyStateError"),
    unit: t("overlay.degrees"),
    read: ({ steady_state_position_error_rad: rad }) => (rad === null ? null : toDegrees(rad)),
    isBest: "always",
  },
  {
    name: t("overlay.recovery"),
    unit: t("overlay.secondsUnit"),
    read: (metrics) => metrics.recovery_time_s,
    isBest: "always",
  },
  {
    name: t("overlay.rmsStiffness"),
    unit: t("overlay.stiffnessUnit"),
    read: (metrics) => metrics.rms_stiffness_error_nm_per_rad,
    isBest: "in one length",
  },
  {
    name: t("overlay.peakTorque"),
    unit: t("overlay.torqueUnit"),
    read: (metrics) => metrics.peak_torque1_nm,
    isBest: null,
  },
];

/**
 * Marks the clearly smallest value if the runs are comparable; a run without recovery is never
 * marked.
 */
export function findBest(
  curves: readonly OverlayCurve[],
  { read, isBest }: Column,
  isAlike: boolean,
): number {
  const mayBe = isAlike && (isBest === "always" || (isBest !== null && haveEqualLength(curves)));
  if (!mayBe) return -1;
  return bestOf(
    curves.map(({ metrics }) => (metrics && read(metrics)) ?? Number.POSITIVE_INFINITY),
  );
}

/** Named after its controller, if the curve has several. */
function windowOf({ window, lane, measuredLane }: OverlayCurve): string {
  return window === null
    ? formatNumber(null)
    : describeMeasured({ ...window, lanes: [measuredLane] }, lane !== measuredLane);
}

interface OverlayTableProps {
  curves: readonly OverlayCurve[];
  /** Difference of the settings of the runs; null if unknown. */
  difference: RunDifference | null;
}

/** The curves of an overlay as numbers. */
export function OverlayTable({ curves, difference }: OverlayTableProps) {
  const why = explainDifference(curves, difference);
  const columns: MetricsColumn[] = COLUMNS.map((column) => ({
    key: column.name,
    title: (
      <>
        {column.name}, <span class="unit">{column.unit}</span>
      </>
    ),
    cell: (row) => {
      const metrics = curves[row]?.metrics;
      return formatError(metrics && column.read(metrics));
    },
    best: findBest(curves, column, why === ""),
  }));
  const window: MetricsColumn = {
    key: t("overlay.window"),
    title: t("overlay.window"),
    hint: t(`overlay.windowHint.${curves[0]?.alignment ?? "window"}`),
    class: "overlay-window",
    cell: (row) => windowOf(curves[row] as OverlayCurve),
  };
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls is reached by keyboard
    <section class="scroll overlay-table" tabIndex={0} aria-label={t("overlay.table")}>
      <MetricsTable
        class="metrics"
        caption={
          <span>
            {t("overlay.table")}
            {why !== "" && <small class="unit"> {t("overlay.noBest", { why })}</small>}
            {why === "" && !haveEqualLength(curves) && (
              <small class="unit"> {t("overlay.noBestRms")}</small>
            )}
          </span>
        }
        corner={t("overlay.run")}
        rows={curves.map((curve) => ({
          key: curve.key,
          look: curve.lineStyle,
          name: nameCurve(curve),
        }))}
        columns={[window, ...columns]}
      />
      <details>
        <summary>{t("metrics.all")}</summary>
        <AllMetrics
          caption={t("overlay.table")}
          lanes={curves.map((curve) => ({
            key: curve.key,
            look: curve.lineStyle,
            name: nameCurve(curve),
            metrics: curve.metrics,
            isDisturbed: curve.window !== null && isDisturbed(curve.window),
          }))}
        />
      </details>
    </section>
  );
}
