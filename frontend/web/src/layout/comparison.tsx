import { useCallback } from "preact/hooks";
import type { LaneRow, SessionState } from "../api/types";
import { inkOf } from "../plots/inks";
import { Swatch } from "../plots/legend";
import { isLive, samples } from "../state/session";
import { text } from "../text/en";
import { formatNumber, toDegrees } from "../units";
import { bestOf } from "../widgets/best";
import { useLiveText } from "../widgets/live";
import { recoveryOf, sinceOf } from "./window";

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
  hint?: string | undefined;
  children: string;
}

function Cell({ isBest, hint, children }: CellProps) {
  return (
    <td class={isBest ? "is-best" : ""} title={hint}>
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

const lookOf = ({ stretches }: LaneRow) => inkOf(stretches.at(-1)?.ink ?? 0);

const degrees = (rad: number | undefined) =>
  formatNumber(rad === undefined ? null : toDegrees(rad), 3, 3);

/** The lanes in numbers since the last change, the best of each column marked. */
export function Comparison({ state }: { state: SessionState }) {
  const { lanes, window, load_window: load } = state;
  const metrics = lanes.map((lane) => lane.in_window);
  const recoveries = lanes.map((lane) => recoveryOf(lane.since_load, load));
  const bestRms = bestOf(metrics.map((row) => row?.rms_position_error_rad));
  const bestPeak = bestOf(metrics.map((row) => row?.peak_position_error_rad));
  const bestRecovery = bestOf(
    lanes.map((lane) => lane.since_load && (lane.since_load.recovery_time_s ?? Infinity)),
  );
  const deg = <span class="unit">{compare.degrees}</span>;
  return (
    <table class="comparison" aria-label={compare.heading}>
      <caption>{sinceOf(window)}</caption>
      <thead>
        <tr>
          <th scope="col">{compare.lane}</th>
          <th scope="col">
            {isLive.value ? compare.now : compare.lastKnown} {deg}
          </th>
          <th scope="col">
            {compare.rms} {deg}
          </th>
          <th scope="col">
            {compare.peak} {deg}
          </th>
          <th scope="col" title={text.windows.recovery}>
            {compare.recovery}{" "}
            <span class="unit">{compare.recoveredFrom(load?.start_s ?? null)}</span>
          </th>
        </tr>
      </thead>
      <tbody>
        {lanes.map((lane, index) => (
          <tr key={lane.lane}>
            <th scope="row">
              <Swatch look={lookOf(lane)} />
              {lane.name}
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
            <Cell isBest={index === bestRecovery} hint={recoveries[index]?.hint}>
              {recoveries[index]?.words ?? ""}
            </Cell>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
