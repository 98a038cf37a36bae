import type { LaneRow, SessionState } from "../core/api/types";
import { lineStyleOfLane } from "../core/plots/linestyles";
import { type MetricsColumn, MetricsTable } from "../core/plots/metricstable";
import { isArm } from "../core/state/arm";
import { LANES_OF_ARM } from "../core/state/joints";
import { isLive } from "../core/state/session";
import { text } from "../core/text/en";
import { formatNumber, toDegrees } from "../core/units";
import { AllMetricsButton } from "./allmetrics";
import { CurrentError } from "./currenterror";
import { bestIn, hasEnded, recoveryNameOf, recoveryOf, sinceOf } from "./window";

const { compare } = text;

const lookOf = ({ segments, lane }: LaneRow) =>
  lineStyleOfLane(
    segments.at(-1)?.line_style ?? 0,
    lane === 1 || (isArm.value && lane <= LANES_OF_ARM),
  );

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
      title: inUnit(isLive.value ? compare.now : compare.lastKnown, compare.degrees),
      cell: (row) => <CurrentError of={lanes[row]} maxDigits={3} />,
    },
    {
      key: "rms",
      title: inUnit(compare.rms, compare.degrees),
      cell: (row) => degrees(metrics[row]?.rms_position_error_rad),
      best: bestIn(
        state,
        metrics.map((row) => row?.rms_position_error_rad),
      ),
    },
    {
      key: "peak",
      title: inUnit(compare.peak, compare.degrees),
      cell: (row) => degrees(metrics[row]?.peak_position_error_rad),
      best: bestIn(
        state,
        metrics.map((row) => row?.peak_position_error_rad),
      ),
    },
    {
      key: "recovery",
      title: inUnit(recoveryNameOf(state).name, compare.seconds),
      hint: recoveryNameOf(state).hint,
      cell: (row) => (ended[row] ? compare.ended : (recoveries[row]?.words ?? "")),
      cellHint: (row) => (ended[row] ? compare.endedHint : recoveries[row]?.hint),
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
      label={isBench ? compare.benchHeading : compare.heading}
      caption={
        <span class="line comparison-caption">
          <span class="grow clip">{sinceOf(window)}</span>
          <AllMetricsButton state={state} />
        </span>
      }
      {...(isBench ? { captionHint: compare.benchHint } : {})}
      corner={compare.lane}
      rows={lanes.map((lane) => ({ key: String(lane.lane), look: lookOf(lane), name: lane.name }))}
      columns={columns}
    />
  );
}
