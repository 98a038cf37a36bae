import type { SessionState } from "../api/types";
import { isLive, samples } from "../state/session";
import { text } from "../text/en";
import { formatNumber, toDegrees } from "../units";
import { useLiveText } from "./live";

const degrees = (rad: number | null | undefined) =>
  formatNumber(rad === null || rad === undefined ? null : toDegrees(rad), 3, 4);
const readError = () => degrees(samples.ring.newest("position_error_rad"));

function CurrentError() {
  const element = useLiveText<HTMLSpanElement>(readError);
  return <span ref={element} />;
}

/** Null: a load came and the error is not small again; undefined: no load came. */
function Recovery({ seconds }: { seconds: number | null | undefined }) {
  if (typeof seconds !== "number") {
    const word = seconds === null ? text.readout.notYet : text.readout.noLoad;
    return <span class="waiting">{word}</span>;
  }
  return (
    <>
      {formatNumber(seconds, 3, 2)} <span class="unit">s</span>
    </>
  );
}

/** The numbers that tell how well the controller does. */
export function Readout({ state }: { state: SessionState }) {
  const { since_load: sinceLoad, since_start: sinceStart } = state.metrics;
  const metrics = sinceLoad ?? sinceStart;
  const labels = sinceLoad ? text.readout.sinceLoad : text.readout.sinceStart;
  return (
    <dl class="readout" aria-label={text.readout.heading}>
      <div class="is-main">
        <dt>{isLive.value ? text.readout.error : text.readout.lastError}</dt>
        <dd>
          <CurrentError /> <span class="unit">deg</span>
        </dd>
      </div>
      <div>
        <dt>{labels.rms}</dt>
        <dd>
          {degrees(metrics?.rms_position_error_rad)} <span class="unit">deg</span>
        </dd>
      </div>
      <div>
        <dt>{labels.peak}</dt>
        <dd>
          {degrees(metrics?.peak_position_error_rad)} <span class="unit">deg</span>
        </dd>
      </div>
      <div title={text.readout.recoveryHint}>
        <dt>{text.readout.recovery}</dt>
        <dd>
          <Recovery seconds={sinceLoad?.recovery_time_s} />
        </dd>
      </div>
    </dl>
  );
}
