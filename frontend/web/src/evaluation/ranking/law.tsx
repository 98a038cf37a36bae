import type { Outcome, Row } from "../../core/api/ranking";
import { Formula } from "../../core/equations/formula";
import { lawOf } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { formatNumber, toDegrees } from "../../core/units";
import { MathSymbol } from "../../core/widgets/symbol";
import { quantileOf, RECOVERY, SHARE, writeOutcome } from "./columns";
import { chosen, isBusy, openInLab, results, splitSource, titleOfRow } from "./ranking";

function Source({ source }: { source: string }) {
  if (source === "") return null;
  const { said: citation, doi } = splitSource(source);
  return (
    <p class="hint">
      {t("ranking.source")} {citation}
      {doi !== "" && (
        <a href={`https://doi.org/${doi}`} target="_blank" rel="noreferrer">
          {t("ranking.doi", { doi })}
        </a>
      )}
    </p>
  );
}

/** Origin of its parameters. */
function Tuning({ row: { tuning, variant } }: { row: Row }) {
  if (!tuning) return <p class="hint">{t(`ranking.variants.${variant}`)}</p>;
  const { candidates, trials, validation, seed } = tuning;
  return (
    <>
      <p class="hint">{t("ranking.tuned", { candidates, trials, validation, seed })}</p>
      <p class="hint">
        {Object.entries(tuning.values)
          .map(([name, value]) => `${name} ${formatNumber(value, 4)}`)
          .join(", ")}
      </p>
    </>
  );
}

const percentOf = (value: number | null | undefined): string =>
  value === null || value === undefined ? t("ranking.fault") : formatNumber(100 * value);
const secondsOf = (value: number | null | undefined): string =>
  value === null || value === undefined ? "–" : formatNumber(value);

function ScenarioRow({ row, outcome }: { row: Row; outcome: Outcome }) {
  return (
    <tr>
      <th scope="row">
        <button
          type="button"
          title={t("ranking.seeWorst")}
          disabled={isBusy.value !== ""}
          onClick={() => void openInLab(row.key, outcome.worst)}
        >
          {outcome.title}
        </button>
      </th>
      <td class="number">{writeOutcome(outcome)}</td>
      <td class="number">{`${percentOf(outcome.median[SHARE])} / ${percentOf(outcome.worst_values[SHARE])}`}</td>
      <td class="number">
        {`${secondsOf(outcome.median[RECOVERY])} / ${secondsOf(outcome.worst_values[RECOVERY])}`}
      </td>
      <td class="number">{t("ranking.ofRuns", { held: outcome.held, runs: outcome.runs })}</td>
    </tr>
  );
}

function Scenarios({ row }: { row: Row }) {
  return (
    <table class="table">
      <caption>{t("ranking.scenarios")}</caption>
      <thead>
        <tr>
          {t("ranking.scenarioHeads", { returnObjects: true }).map((head) => (
            <th key={head} scope="col">
              {head}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {row.scenarios.map((outcome) => (
          <ScenarioRow key={outcome.scenario} row={row} outcome={outcome} />
        ))}
      </tbody>
    </table>
  );
}

const METRICS = [
  "rms_position_error_rad",
  "peak_position_error_rad",
  "recovery_time_s",
  "steady_state_position_error_rad",
  "rms_stiffness_error_nm_per_rad",
  "peak_stiffness_error_share",
  "rms_torque1_nm",
  "rms_torque2_nm",
  "work_j",
  "torque1_variation_nm_per_s",
] as const;

/** Medians and 90 % quantiles of the trials, by family. */
function Trials({ row }: { row: Row }) {
  const families = Object.entries(row.families);
  return (
    <table class="table">
      <caption>{t("ranking.trials")}</caption>
      <thead>
        <tr>
          <td />
          {families.map(([name]) => (
            <th key={name} scope="col">
              {t("ranking.family", { name })}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {METRICS.map((metric) => (
          <tr key={metric}>
            <th scope="row">{t(`ranking.metrics.${metric}`)}</th>
            {families.map(([name, family]) => {
              const write = (share: "middle" | "most") => {
                const value = quantileOf(family, metric, share);
                if (value === null) return "–";
                const scaled = metric.endsWith("_rad") && !metric.endsWith("_per_rad");
                const percent = metric.endsWith("_share");
                return formatNumber(scaled ? toDegrees(value) : percent ? 100 * value : value);
              };
              return <td key={name} class="number">{`${write("middle")} / ${write("most")}`}</td>;
            })}
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** The selected row: the law, its tuning, its fixed scenarios and its trials. */
export function LawCard() {
  const row = results.value?.rows.find(({ key }) => key === chosen.value);
  if (row === undefined) return null;
  const law = lawOf(row.law);
  return (
    <section class="surface card" aria-labelledby="ranking-law-title">
      <h3 id="ranking-law-title">{titleOfRow(row)}</h3>
      {law && (
        <p>
          <MathSymbol text={law.summary} />
        </p>
      )}
      {law && <Formula tex={law.equation} />}
      {law && <Source source={law.source} />}
      <Tuning row={row} />
      <div class="scroll">
        <Scenarios row={row} />
        <Trials row={row} />
      </div>
    </section>
  );
}
