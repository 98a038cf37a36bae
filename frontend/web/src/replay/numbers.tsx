import { inkOf } from "../plots/inks";
import { describeMeasured, explainSettled } from "../runs/measured";
import { text } from "../text/replay";
import { formatNumber, toDegrees } from "../units";
import { isPlaying, seek } from "./clock";
import type { Recording, Run } from "./data";
import { Swatch } from "./plot";

const { numbers } = text;

function degrees(rad: number | null | undefined): string {
  return formatNumber(rad == null ? rad : toDegrees(rad), 3, 4);
}

/** Of who controlled the lane in the window. */
const inkIn = ({ stretches, window }: Run, lane: number): number =>
  stretches[lane]?.filter(({ start_s: start }) => start <= window.start_s).at(-1)?.ink ?? lane;

function Metrics({ run }: { run: Run }) {
  return (
    <table class="metrics">
      <caption title={numbers.hint}>{numbers.heading(describeMeasured(run.window))}</caption>
      <thead>
        <tr>
          <th scope="col" rowSpan={2}>
            <span class="visually-hidden">{numbers.lane}</span>
          </th>
          <th scope="colgroup" colSpan={3}>
            {numbers.position} <span class="unit">{numbers.degrees}</span>
          </th>
          <th scope="colgroup" colSpan={2}>
            {numbers.stiffness} <span class="unit">{numbers.stiffnessUnit}</span>
          </th>
        </tr>
        <tr>
          <th scope="col">{numbers.rms}</th>
          <th scope="col">{numbers.peak}</th>
          <th scope="col" title={explainSettled(run.window)}>
            {numbers.settled}
          </th>
          <th scope="col">{numbers.rms}</th>
          <th scope="col">{numbers.peak}</th>
        </tr>
      </thead>
      <tbody>
        {run.window.lanes.map((lane, index) => {
          const row = run.metrics[index];
          return (
            <tr key={`${index}.${lane}`}>
              <th scope="row">
                <Swatch curve={inkOf(inkIn(run, index))} />
                <span class="legend-name">{lane}</span>
              </th>
              <td>{degrees(row?.rms_position_error_rad)}</td>
              <td>{degrees(row?.peak_position_error_rad)}</td>
              <td>{degrees(row?.settled_position_error_rad)}</td>
              <td>{formatNumber(row?.rms_stiffness_error_nm_per_rad, 3, 4)}</td>
              <td>{formatNumber(row?.peak_stiffness_error_nm_per_rad, 3, 4)}</td>
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

function Events({ run }: { run: Run }) {
  return (
    <div class="events">
      <h2>{text.events.heading}</h2>
      {run.events.length === 0 && <p class="hint">{text.events.none}</p>}
      <ul>
        {run.events.map((event, index) => (
          <li key={`${index}.${event.label}`}>
            <button
              type="button"
              aria-label={text.events.jump(text.transport.seconds(event.time_s), event.label)}
              onClick={() => {
                isPlaying.value = false;
                seek(event.time_s);
              }}
            >
              <span>{text.transport.seconds(event.time_s)}</span> {event.label}
            </button>
          </li>
        ))}
      </ul>
    </div>
  );
}

export function Numbers({ recording: { run } }: { recording: Recording }) {
  return (
    <section class="numbers">
      <Metrics run={run} />
      <Events run={run} />
    </section>
  );
}
