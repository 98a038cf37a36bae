import type { LaneRow, SessionState } from "../core/api/types";
import { lineStyleOfLane } from "../core/plots/linestyles";
import { type MetricsColumn, MetricsTable } from "../core/plots/metricstable";
import { jointCount } from "../core/state/arm";
import { isLive } from "../core/state/session";
import { t } from "../core/text/t";
import { formatNumber, toDegrees } from "../core/units";
import { AllMetricsButton } from "./allmetrics";
import { CurrentError } from "./currenterror";
import { bestIn, hasEnded, recoveryNameOf, recoveryOf, sinceOf } from "./window";

const lookOf = ({ segments, lane }: LaneRow) =>
  lineStyleOfLane(segments.at(-1)?.line_style ?? 0, lane <= jointCount.value);

const degrees = (rad: number | undefined) =>
  formatNumber(rad === undefined ? null : toDegrees(rad), 3, 3);

/**
 * Metrics of the lanes in one window, since the last change; the best is marked if all lanes are
 * comparable.
 */
export function Comparison({ state }: { state: SessionState }) {
  const { lanes, window } = state;
  const metrics = lanes.map((lane) => lane.in_window);
  const ended = lanes.map((lane) => hasEnded(lane, state));
  const recoveries = lanes.map((lane) => recoveryOf(lane.in_window, window));
  const inUnit = (name: string, unit: string) => (
    <>
      {name} <span class="unit">{unit}</span>
    </>
  );
  const columns: MetricsColumn[] = [
    {
      key: "now",
      title: inUnit(isLive.value ? t("compare.now") : t("compare.lastKnown"), t("compare.degrees")),
      cell: (row) => <CurrentError of={lanes[row]} maxDigits={3} />,
    },
    {
      key: "rms",
      title: inUnit(t("compare.rms"), t("compare.degrees")),
      cell: (row) => degrees(metrics[row]?.rms_position_error_rad),
      best: bestIn(
        state,
        metrics.map((row) => row?.rms_position_error_rad),
      ),
    },
    {
      key: "peak",
      title: inUnit(t("compare.peak"), t("compare.degrees")),
      cell: (row) => degrees(metrics[row]?.peak_position_error_rad),
      best: bestIn(
        state,
        metrics.map((row) => row?.peak_position_error_rad),
      ),
    },
    {
      key: "recovery",
      title: inUnit(recoveryNameOf(state).name, t("compare.seconds")),
      hint: recoveryNameOf(state).hint,
      cell: (row) => (ended[row] ? t("compare.ended") : (recoveries[row]?.words ?? "")),
      cellHint: (row) => (ended[row] ? t("compare.endedHint") : recoveries[row]?.hint),
      best: bestIn(
        state,
        metrics.map((known, row) => known && (recoveries[row]?.seconds ?? Infinity)),
      ),
    },
  ];
  const isBench = state.bench !== null;
  return (
    <MetricsTable
      class="surface metrics comparison"
      label={isBench ? t("compare.benchHeading") : t("compare.heading")}
      caption={
        <span class="line comparison-caption">
          <span class="grow clip">{sinceOf(window)}</span>
          <AllMetricsButton state={state} />
        </span>
      }
      {...(isBench ? { captionHint: t("compare.benchHint") } : {})}
      corner={t("compare.lane")}
      rows={lanes.map((lane) => ({ key: String(lane.lane), look: lookOf(lane), name: lane.name }))}
      columns={columns}
    />
  );
}
