import type { Stability } from "../../core/api/design";
import { text } from "../../core/text/en";
import { formatNumber, toDegrees } from "../../core/units";
import { isStale, stability } from "./stability";
import { rangeOf } from "./words";

const words = text.stability;
const ratio = (value: number) => formatNumber(value, 3, 2);
const FAINT: readonly string[] = ["D", "D1", "D2"];

const gainOf = (gain: number | null) =>
  gain === null ? words.noGain : words.gainValue(formatNumber(toDegrees(gain), 3, 4));

function Lines({ found }: { found: Stability }) {
  const { floor_rad_s_per_nm: floor } = found;
  return (
    <dl class="stability-lines">
      <div title={words.slowestHint}>
        <dt>{words.slowest}</dt>
        <dd class={found.slowest_rad_per_s < 0 ? "" : "is-unstable"}>
          {words.rate(formatNumber(found.slowest_rad_per_s, 3, 1))}
        </dd>
      </div>
      <div title={words.dampingHint}>
        <dt>{words.damping}</dt>
        <dd>{formatNumber(found.least_damping, 2, 2)}</dd>
      </div>
      <div title={words.gainHint}>
        <dt>{words.gain}</dt>
        <dd>{gainOf(found.ramp_gain_rad_s_per_nm)}</dd>
      </div>
      {floor !== null && (
        <div title={words.floorHint}>
          <dt>{words.floor}</dt>
          <dd>{gainOf(floor)}</dd>
        </div>
      )}
      {found.is_observed && (
        <div title={words.fastestHint}>
          <dt>{words.fastest(words.sensing[found.encoders])}</dt>
          <dd>
            {found.fastest_observer_rad_per_s === null
              ? words.anyObserver
              : words.rate(formatNumber(found.fastest_observer_rad_per_s, 3, 0))}
          </dd>
        </div>
      )}
    </dl>
  );
}

function Ranges({ found }: { found: Stability }) {
  if (found.ranges.length === 0) return <p class="hint">{words.unstableAsItIs}</p>;
  const shown = found.ranges.filter(
    ({ symbol, low, high }) => !FAINT.includes(symbol) || low !== null || high !== null,
  );
  return (
    <table>
      <caption title={words.rangesHint}>{words.ranges}</caption>
      <thead>
        <tr>
          <th scope="col">{words.parameter}</th>
          <th scope="col">{words.range}</th>
          <th scope="col">{words.now}</th>
        </tr>
      </thead>
      <tbody>
        {shown.map((one) => (
          <tr key={one.symbol}>
            <th scope="row">{words.times(one.symbol)}</th>
            <td>{rangeOf(one)}</td>
            <td class="present">{ratio(one.present)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** Theorem 1 in numbers: poles with the true plant, what ẇ costs, how wrong the model may be. */
export function StabilityTable() {
  const found = stability.value;
  return (
    <section class={`stability ${isStale.value ? "is-stale" : ""}`} aria-label={words.title}>
      <h3>{words.title}</h3>
      {found === null ? (
        <p class="hint">{text.design.asking}</p>
      ) : (
        <>
          <Lines found={found} />
          <Ranges found={found} />
        </>
      )}
    </section>
  );
}
