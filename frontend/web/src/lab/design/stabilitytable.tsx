import type { Margins, Stability } from "../../core/api/design";
import { t } from "../../core/text/t";
import { formatNumber, toDegrees } from "../../core/units";
import { isStale, margins, stability } from "./stability";
import { errorsOf, gainRangeOf, rangeOf } from "./words";

const ratio = (value: number) => formatNumber(value, 3, 2);
const FAINT: readonly string[] = ["D", "D1", "D2"];

const gainOf = (gain: number | null) =>
  gain === null
    ? t("stability.noGain")
    : t("stability.gainValue", { degrees: formatNumber(toDegrees(gain), 3, 4) });

function Lines({ result }: { result: Stability }) {
  const { floor_rad_s_per_nm: floor } = result;
  return (
    <dl class="facts small">
      <div title={t("stability.slowestHint")}>
        <dt>{t("stability.slowest")}</dt>
        <dd class={result.slowest_rad_per_s < 0 ? "" : "bad"}>
          {t("stability.rate", { value: formatNumber(result.slowest_rad_per_s, 3, 1) })}
        </dd>
      </div>
      <div title={t("stability.dampingHint")}>
        <dt>{t("stability.damping")}</dt>
        <dd>{formatNumber(result.least_damping, 2, 2)}</dd>
      </div>
      <div title={t("stability.gainHint")}>
        <dt>{t("stability.gain")}</dt>
        <dd>{gainOf(result.ramp_gain_rad_s_per_nm)}</dd>
      </div>
      <div title={t("stability.l1Hint")}>
        <dt>{t("stability.l1")}</dt>
        <dd>{gainOf(result.l1_gain_rad_s_per_nm)}</dd>
      </div>
      {floor !== null && (
        <div title={t("stability.floorHint")}>
          <dt>{t("stability.floor")}</dt>
          <dd>{gainOf(floor)}</dd>
        </div>
      )}
      {result.is_observed && (
        <div title={t("stability.fastestHint")}>
          <dt>{t("stability.fastest", { sensing: t(`stability.sensing.${result.encoders}`) })}</dt>
          <dd>
            {result.fastest_observer_rad_per_s === null
              ? t("stability.anyObserver")
              : t("stability.rate", {
                  value: formatNumber(result.fastest_observer_rad_per_s, 3, 0),
                })}
          </dd>
        </div>
      )}
    </dl>
  );
}

function MarginLines({ result }: { result: Margins }) {
  const sensing = t(`stability.sensing.${result.encoders}`);
  if (!result.is_stable) return <p class="hint">{t("stability.noMargins", { sensing })}</p>;
  const { delay_s: delay, joint_error: norm, joint_errors: errors } = result;
  const lines: [string, string, string][] = [
    [t("stability.modulus"), t("stability.modulusHint"), ratio(result.modulus)],
    [
      t("stability.delay"),
      t("stability.delayHint"),
      delay === null
        ? t("stability.anyDelay")
        : t("stability.milliseconds", { value: formatNumber(1000 * delay, 2, 1) }),
    ],
    [t("stability.gain1"), t("stability.gainMarginHint"), gainRangeOf(result.torque1_gain)],
    [t("stability.gain2"), t("stability.gainMarginHint"), gainRangeOf(result.torque2_gain)],
    [
      t("stability.joint"),
      t("stability.jointHint"),
      norm === null || errors === null
        ? t("stability.noJoint")
        : t("stability.jointValue", { norm: ratio(norm), errors: errorsOf(errors) }),
    ],
  ];
  return (
    <dl class="facts small" aria-label={t("stability.margins", { sensing })}>
      {lines.map(([name, hint, value]) => (
        <div key={name} title={hint}>
          <dt>{name}</dt>
          <dd>{value}</dd>
        </div>
      ))}
      {result.is_switching && <p class="hint">{t("stability.switching")}</p>}
    </dl>
  );
}

function Ranges({ result }: { result: Stability }) {
  if (result.ranges.length === 0) return <p class="hint">{t("stability.unstableAsItIs")}</p>;
  const shown = result.ranges.filter(
    ({ symbol, low, high }) => !FAINT.includes(symbol) || low !== null || high !== null,
  );
  return (
    <table class="metrics strong">
      <caption title={t("stability.rangesHint")}>{t("stability.ranges")}</caption>
      <thead>
        <tr>
          <th scope="col">{t("stability.parameter")}</th>
          <th scope="col">{t("stability.range")}</th>
          <th scope="col">{t("stability.now")}</th>
        </tr>
      </thead>
      <tbody>
        {shown.map((range) => (
          <tr key={range.symbol}>
            <th scope="row">{t("stability.times", { symbol: range.symbol })}</th>
            <td>{rangeOf(range)}</td>
            <td class="muted">{ratio(range.present)}</td>
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
    <section class={`stack ${isStale.value ? "is-stale" : ""}`} aria-label={t("stability.title")}>
      <h3>{t("stability.title")}</h3>
      {result === null ? (
        <p class="hint">{t("design.asking")}</p>
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
