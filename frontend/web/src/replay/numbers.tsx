import { inkOf } from "../plots/inks";
import { text } from "../text/replay";
import { formatNumber, toDegrees } from "../units";
import { isPlaying, seek } from "./clock";
import type { Recording, Run } from "./data";
import { Swatch } from "./plot";

const { numbers } = text;

function degrees(rad: number | null | undefined): string {
  return formatNumber(rad == null ? rad : toDegrees(rad), 3, 4);
}

/** Of all who controlled the lane. */
const inksOf = ({ stretches }: Run, lane: number): number[] => [
  ...new Set(stretches[lane]?.map(({ ink }) => ink)),
];

function Metrics({ run }: { run: Run }) {
  return (
    <table class="metrics">
      <caption title={numbers.hint}>{numbers.heading}</caption>
      <thead>
        <tr>
          <th scope="col" rowSpan={2}>
            <span class="visually-hidden">{numbers.lane}</span>
          </th>
          <th scope="colgroup" colSpan={2}>
            {numbers.position} <span class="unit">{numbers.degrees}</span>
          </th>
          <th scope="colgroup" colSpan={2}>
            {numbers.stiffness} <span class="unit">{numbers.stiffnessUnit}</span>
          </th>
        </tr>
        <tr>
          {[0, 1].map((group) => [
            <th key={`rms${group}`} scope="col">
              {numbers.rms}
            </th>,
            <th key={`peak${group}`} scope="col">
              {numbers.peak}
            </th>,
          ])}
        </tr>
      </thead>
      <tbody>
        {run.lanes.map((lane, index) => {
          const row = run.metrics[index] ?? {};
          return (
            <tr key={`${index}.${lane}`}>
              <th scope="row">
                {inksOf(run, index).map((ink) => (
                  <Swatch key={ink} curve={inkOf(ink)} />
                ))}
                <span class="legend-name">{lane}</span>
              </th>
              <td>{degrees(row.position_error_rad_rms)}</td>
              <td>{degrees(row.position_error_rad_peak)}</td>
              <td>{formatNumber(row.stiffness_error_nm_per_rad_rms, 3, 4)}</td>
              <td>{formatNumber(row.stiffness_error_nm_per_rad_peak, 3, 4)}</td>
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
