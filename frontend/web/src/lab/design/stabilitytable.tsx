import type { Margins, Stability } from "../../core/api/design";
import { text } from "../../core/text/en";
import { formatNumber, toDegrees } from "../../core/units";
import { isStale, margins, stability } from "./stability";
import { errorsOf, gainRangeOf, rangeOf } from "./words";

const words = text.stability;
const ratio = (value: number) => formatNumber(value, 3, 2);
const FAINT: readonly string[] = ["D", "D1", "D2"];

const gainOf = (gain: number | null) =>
  gain === null ? words.noGain : words.gainValue(formatNumber(toDegrees(gain), 3, 4));

function Lines({ result }: { result: Stability }) {
  const { floor_rad_s_per_nm: floor } = result;
  return (
    <dl class="facts small">
      <div title={words.slowestHint}>
        <dt>{words.slowest}</dt>
        <dd class={result.slowest_rad_per_s < 0 ? "" : "bad"}>
          {words.rate(formatNumber(result.slowest_rad_per_s, 3, 1))}
        </dd>
      </div>
      <div title={words.dampingHint}>
        <dt>{words.damping}</dt>
        <dd>{formatNumber(result.least_damping, 2, 2)}</dd>
      </div>
      <div title={words.gainHint}>
        <dt>{words.gain}</dt>
        <dd>{gainOf(result.ramp_gain_rad_s_per_nm)}</dd>
      </div>
      <div title={words.l1Hint}>
        <dt>{words.l1}</dt>
        <dd>{gainOf(result.l1_gain_rad_s_per_nm)}</dd>
      </div>
      {floor !== null && (
        <div title={words.floorHint}>
          <dt>{words.floor}</dt>
          <dd>{gainOf(floor)}</dd>
        </div>
      )}
      {result.is_observed && (
        <div title={words.fastestHint}>
          <dt>{words.fastest(words.sensing[result.encoders])}</dt>
          <dd>
            {result.fastest_observer_rad_per_s === null
              ? words.anyObserver
              : words.rate(formatNumber(result.fastest_observer_rad_per_s, 3, 0))}
          </dd>
        </div>
      )}
    </dl>
  );
}

function MarginLines({ result }: { result: Margins }) {
  const sensing = words.sensing[result.encoders];
  if (!result.is_stable) return <p class="hint">{words.noMargins(sensing)}</p>;
  const { delay_s: delay, joint_error: norm, joint_errors: errors } = result;
  const lines: [string, string, string][] = [
    [words.modulus, words.modulusHint, ratio(result.modulus)],
    [
      words.delay,
      words.delayHint,
      delay === null ? words.anyDelay : words.milliseconds(formatNumber(1000 * delay, 2, 1)),
    ],
    [words.gain1, words.gainMarginHint, gainRangeOf(result.torque1_gain)],
    [words.gain2, words.gainMarginHint, gainRangeOf(result.torque2_gain)],
    [
      words.joint,
      words.jointHint,
      norm === null || errors === null
        ? words.noJoint
        : words.jointValue(ratio(norm), errorsOf(errors)),
    ],
  ];
  return (
    <dl class="facts small" aria-label={words.margins(sensing)}>
      {lines.map(([name, hint, value]) => (
        <div key={name} title={hint}>
          <dt>{name}</dt>
          <dd>{value}</dd>
        </div>
      ))}
      {result.is_switching && <p class="hint">{words.switching}</p>}
    </dl>
  );
}

function Ranges({ result }: { result: Stability }) {
  if (result.ranges.length === 0) return <p class="hint">{words.unstableAsItIs}</p>;
  const shown = result.ranges.filter(
    ({ symbol, low, high }) => !FAINT.includes(symbol) || low !== null || high !== null,
  );
  return (
    <table class="metrics strong">
      <caption title={words.rangesHint}>{words.ranges}</caption>
      <thead>
        <tr>
          <th scope="col">{words.parameter}</th>
          <th scope="col">{words.range}</th>
          <th scope="col">{words.now}</th>
        </tr>
      </thead>
      <tbody>
        {shown.map((range) => (
          <tr key={range.symbol}>
            <th scope="row">{words.times(range.symbol)}</th>
            <td>{rangeOf(range)}</td>
            <td class="present">{ratio(range.present)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** The linear loop about rest: poles with the true plant, gains from ẇ, ranges and margins. */
export function StabilityTable() {
  const result = stability.value;
  return (
    <section class={`stack ${isStale.value ? "is-stale" : ""}`} aria-label={words.title}>
      <h3>{words.title}</h3>
      {result === null ? (
        <p class="hint">{text.design.asking}</p>
      ) : (
        <>
          <Lines result={result} />
          <Ranges result={result} />
          {margins.value && <MarginLines result={margins.value} />}
        </>
      )}
    </section>
  );
}
