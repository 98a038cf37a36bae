import { useCallback } from "preact/hooks";
import type { LaneRow, Metrics } from "../api/types";
import { inkOf } from "../plots/inks";
import { Swatch } from "../plots/legend";
import { laneNames } from "../state/lanes";
import { samples } from "../state/session";
import { text } from "../text/en";
import { formatNumber, toDegrees } from "../units";
import { bestOf } from "./best";
import { useLiveText } from "./live";

const { compare } = text;

function CurrentError({ lane }: { lane: number }) {
  const read = useCallback(
    () => formatNumber(toDegrees(samples.ring.newest("position_error_rad", lane)), 3, 3),
    [lane],
  );
  const element = useLiveText<HTMLSpanElement>(read);
  return <span ref={element} />;
}

interface CellProps {
  isBest: boolean;
  children: string;
}

function Cell({ isBest, children }: CellProps) {
  return (
    <td class={isBest ? "is-best" : ""}>
      {isBest && (
        <>
          <span aria-hidden="true">{compare.bestSign}</span>
          <span class="visually-hidden">{compare.best}</span>
        </>
      )}
      {children}
    </td>
  );
}

function recovery(metrics: Metrics | null): string {
  if (metrics === null) return formatNumber(null);
  if (metrics.recovery_time_s === null) return text.readout.notYet;
  return formatNumber(metrics.recovery_time_s, 3, 2);
}

const degrees = (rad: number | undefined) =>
  formatNumber(rad === undefined ? null : toDegrees(rad), 3, 3);

/** The lanes in numbers since the last load, or since the start, the best of each column marked. */
export function Comparison({ lanes }: { lanes: readonly LaneRow[] }) {
  const isSinceLoad = lanes.every((lane) => lane.since_load !== null);
  const metrics = lanes.map((lane) => (isSinceLoad ? lane.since_load : lane.since_start));
  const bestRms = bestOf(metrics.map((row) => row?.rms_position_error_rad));
  const bestPeak = bestOf(metrics.map((row) => row?.peak_position_error_rad));
  const bestRecovery = bestOf(
    lanes.map((lane) => lane.since_load && (lane.since_load.recovery_time_s ?? Infinity)),
  );
  const deg = <span class="unit">{compare.degrees}</span>;
  return (
    <table class="comparison" aria-label={compare.heading}>
      <thead>
        <tr>
          <th scope="col">{isSinceLoad ? compare.since.load : compare.since.start}</th>
          <th scope="col">
            {compare.now} {deg}
          </th>
          <th scope="col">
            {compare.rms} {deg}
          </th>
          <th scope="col">
            {compare.peak} {deg}
          </th>
          <th scope="col" title={text.readout.recoveryHint}>
            {compare.recovery} <span class="unit">{compare.seconds}</span>
          </th>
        </tr>
      </thead>
      <tbody>
        {lanes.map((lane, index) => (
          <tr key={lane.lane}>
            <th scope="row">
              <Swatch look={inkOf(lane.lane)} />
              {laneNames.value[index]}
            </th>
            <td>
              <CurrentError lane={lane.lane} />
            </td>
            <Cell isBest={index === bestRms}>
              {degrees(metrics[index]?.rms_position_error_rad)}
            </Cell>
            <Cell isBest={index === bestPeak}>
              {degrees(metrics[index]?.peak_position_error_rad)}
            </Cell>
            <Cell isBest={index === bestRecovery}>{recovery(lane.since_load)}</Cell>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
