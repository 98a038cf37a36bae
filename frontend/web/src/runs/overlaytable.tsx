import type { Metrics } from "../api/types";
import { type MetricsColumn, MetricsTable } from "../plots/metricstable";
import { text } from "../text/en";
import { formatNumber, toDegrees } from "../units";
import { bestOf } from "../widgets/best";
import { describeMeasured } from "./measured";
import { nameCurve, type Overlaid } from "./overlaid";

const words = text.overlay;

interface Column {
  name: string;
  unit: string;
  read: (metrics: Metrics) => number | null;
}

const COLUMNS: readonly Column[] = [
  {
    name: words.rmsError,
    unit: words.degrees,
    read: (metrics) => toDegrees(metrics.rms_position_error_rad),
  },
  {
    name: words.peakError,
    unit: words.degrees,
    read: (metrics) => toDegrees(metrics.peak_position_error_rad),
  },
  {
    name: words.settledError,
    unit: words.degrees,
    read: ({ settled_position_error_rad: rad }) => (rad === null ? null : toDegrees(rad)),
  },
  { name: words.recovery, unit: words.secondsUnit, read: (metrics) => metrics.recovery_time_s },
  {
    name: words.rmsStiffness,
    unit: words.stiffnessUnit,
    read: (metrics) => metrics.rms_stiffness_error_nm_per_rad,
  },
  { name: words.peakTorque, unit: words.torqueUnit, read: (metrics) => metrics.peak_torque1_nm },
];

/** Whether the numbers are of windows that began in the same way. */
export function areAlike(curves: readonly Overlaid[]): boolean {
  const begins = curves.map(({ window }) => window && `${window.kind} ${window.label}`);
  return !begins.includes(null) && new Set(begins).size === 1;
}

/**
 * Whose value is clearly the smallest is marked, where the windows are alike; a run that never came
 * back is no winner.
 */
function readColumn(curves: readonly Overlaid[], { read }: Column) {
  const values = curves.map(({ metrics }) => (metrics === null ? null : read(metrics)));
  const best = bestOf(values.map((value) => value ?? Number.POSITIVE_INFINITY));
  return { values, best: areAlike(curves) ? best : -1 };
}

/** Named by who controlled in it, where the curve is of several. */
function windowOf({ window, lane, measuredLane }: Overlaid): string {
  return window === null
    ? formatNumber(null)
    : describeMeasured({ ...window, lanes: [measuredLane] }, lane !== measuredLane);
}

/** The curves of an overlay in numbers. */
export function OverlayTable({ curves }: { curves: readonly Overlaid[] }) {
  const columns: MetricsColumn[] = COLUMNS.map((column) => {
    const { values, best } = readColumn(curves, column);
    return {
      key: column.name,
      title: (
        <>
          {column.name} <span class="unit">{column.unit}</span>
        </>
      ),
      cell: (row) => formatNumber(values[row], 3, 4),
      best,
    };
  });
  const window: MetricsColumn = {
    key: words.window,
    title: words.window,
    hint: words.windowHint,
    class: "overlay-window",
    cell: (row) => windowOf(curves[row] as Overlaid),
  };
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls is reached by keyboard
    <section class="overlay-table" tabIndex={0} aria-label={words.table}>
      <MetricsTable
        caption={
          <span>
            {words.table}
            {!areAlike(curves) && <small class="unit"> {words.unequal}</small>}
          </span>
        }
        corner={words.run}
        rows={curves.map((curve) => ({
          key: curve.key,
          look: curve.ink,
          name: nameCurve(curve),
        }))}
        columns={[window, ...columns]}
      />
    </section>
  );
}
