import type { Prediction } from "../../core/api/design";
import { largestTorque } from "../../core/plots/channels";
import { session } from "../../core/state/session";
import { t } from "../../core/text/t";
import { formatLapse, formatNumber } from "../../core/units";
import { currentPrediction, draftPrediction, isPredicting } from "./predictions";
import { degreesOf, torqueOf, verdictOf } from "./words";

interface Line {
  label: string;
  hint: string;
  read: (prediction: Prediction) => string;
  /** Share of a limit, if there is one. */
  share?: (prediction: Prediction) => number | null;
}

const noiseHint = (prediction: Prediction | null) =>
  t(`design.noiseHint.${prediction?.noise?.encoders ?? "rig"}`);
const orDash = <T,>(value: T | null | undefined, format: (value: T) => string) =>
  value === null || value === undefined ? "\u2013" : format(value);

function linesOf(prediction: Prediction | null): Line[] {
  const state = session.value;
  const noise = (name: string, key: "torque1_rms_nm" | "torque2_rms_nm"): Line => ({
    label: t("design.noise", { torque: name }),
    hint: noiseHint(prediction),
    read: ({ noise }) =>
      noise && noise[key] === null ? t("design.unstableLoop") : orDash(noise?.[key], torqueOf),
  });
  const steady = (label: string, hint: string, key: "steady" | "fl"): Line => ({
    label,
    hint,
    read: (shown) =>
      shown[key] === null && shown.demand
        ? t("design.none")
        : orDash(shown[key]?.position_error_rad, degreesOf),
  });
  const peak = (
    name: string,
    key: "peak_torque1_nm" | "peak_torque2_nm",
    motor: "torque1_nm" | "torque2_nm",
  ): Line => ({
    label: t("design.peak", { torque: name }),
    hint: t("design.peakHint"),
    read: ({ demand }) => orDash(demand?.[key], torqueOf),
    share: ({ demand }) => (demand && state ? demand[key] / largestTorque(state, motor) : null),
  });
  return [
    ...(prediction === null
      ? []
      : [steady(t("design.steady", { law: prediction.law }), t("design.steadyHint"), "steady")]),
    ...(prediction?.adds_estimate ? [steady(t("design.fl"), t("design.flHint"), "fl")] : []),
    noise("u₁", "torque1_rms_nm"),
    noise("u₂", "torque2_rms_nm"),
    peak("u₁", "peak_torque1_nm", "torque1_nm"),
    peak("u₂", "peak_torque2_nm", "torque2_nm"),
    {
      label: t("design.atLimit"),
      hint: t("design.peakHint"),
      read: ({ demand }) => orDash(demand?.limited_s, formatLapse),
    },
  ];
}

/** Share of a limit: a bar with a mark at the limit, and a word above it. */
function Bar({ share }: { share: number }) {
  const isBeyond = share > 1;
  return (
    <span class={`share ${isBeyond ? "is-beyond" : ""}`} aria-hidden="true">
      <span style={{ width: `${Math.min(1, share / 1.5) * 100}%` }} />
    </span>
  );
}

function Row({
  line,
  prediction,
  now,
}: {
  line: Line;
  prediction: Prediction;
  now: Prediction | null;
}) {
  const share = line.share?.(prediction) ?? null;
  return (
    <tr>
      <th scope="row" title={line.hint}>
        {line.label}
        {share !== null && <Bar share={share} />}
      </th>
      <td>
        {line.read(prediction)}
        {share !== null && share > 1 && (
          <small class="block bad strong"> {t("design.beyond")}</small>
        )}
      </td>
      <td class="muted">{now && line.read(now)}</td>
    </tr>
  );
}

const TONES = { ok: "is-good", note: "", warn: "is-warn", refuse: "is-bad" } as const;

function Judgement({ prediction }: { prediction: Prediction }) {
  const { reasons } = prediction;
  const verdict = verdictOf(prediction);
  return (
    <section
      class={`line note small judgement ${TONES[verdict]}`}
      role="status"
      aria-label={t("design.verdictIs", { word: t(`design.verdict.${verdict}`) })}
    >
      <span class="rigid strong tone" aria-hidden="true">
        {t(`design.verdictSign.${verdict}`)}
      </span>
      <div>
        <strong>{t(`design.verdict.${verdict}`)}</strong>
        {reasons.length === 0 && <p>{t("design.fine")}</p>}
        {reasons.map((reason) => (
          <p key={reason.code + reason.message}>{reason.message}</p>
        ))}
      </div>
    </section>
  );
}

/** The predicted behaviour of the design, next to that of the settings in use. */
export function Outcome() {
  const prediction = draftPrediction.value;
  const now = currentPrediction.value;
  if (prediction === null) return <p class="hint">{t("design.asking")}</p>;
  return (
    <div class={`stack ${isPredicting.value ? "is-stale" : ""}`}>
      <table class="metrics strong">
        <caption>
          {t("design.expected")}{" "}
          <span class="unit">
            {t("design.at", { stiffness: formatNumber(prediction.stiffness_nm_per_rad, 3, 1) })}
          </span>
        </caption>
        <thead>
          <tr>
            <th scope="col" class="visually-hidden">
              {t("design.quantity")}
            </th>
            <th scope="col">{t("design.value")}</th>
            <th scope="col">{t("design.present")}</th>
          </tr>
        </thead>
        <tbody>
          {linesOf(prediction).map((line) => (
            <Row key={line.label} line={line} prediction={prediction} now={now} />
          ))}
        </tbody>
      </table>
      <Judgement prediction={prediction} />
    </div>
  );
}
