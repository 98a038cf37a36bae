import { useEffect } from "preact/hooks";
import { t } from "../../core/text/t";
import { Page } from "../../core/widgets/pagelayout";
import { MathSymbol } from "../../core/widgets/symbol";
import { COLUMNS } from "./columns";
import { LawCard } from "./law";
import { Pareto } from "./pareto";
import { openRanking, problem, results } from "./ranking";
import { RankingTable } from "./table";

/** Conditions of all measurements. */
function Legend() {
  return (
    <details class="surface card">
      <summary>{t("ranking.legend")}</summary>
      <dl class="cells" style={{ "--cell": "320px" }}>
        {COLUMNS.map(({ key }) => (
          <div key={key}>
            <dt class="strong">{t(`ranking.columns.${key}.name`)}</dt>
            <dd class="muted">{t(`ranking.columns.${key}.hint`)}</dd>
          </div>
        ))}
      </dl>
    </details>
  );
}

/** Every law with the same plant, limits, noise and loads. */
export function RankingPage() {
  useEffect(() => void openRanking(), []);
  const ranking = results.value;
  const versions = [...new Set(ranking?.rows.map(({ version }) => version))];
  return (
    <Page title={t("ranking.title")} lead={t("ranking.lead")} problem={problem.value}>
      {ranking === null ? (
        problem.value === "" && <p class="hint">{t("ranking.loading")}</p>
      ) : (
        <>
          <RankingTable />
          <p class="hint">
            <MathSymbol
              text={t("ranking.provenance", {
                criterion: { ...ranking, versions }.criterion,
                trials: { ...ranking, versions }.trials,
                duration: { ...ranking, versions }.duration_s,
                seed: { ...ranking, versions }.seed,
                protocol: { ...ranking, versions }.protocol,
                versions: { ...ranking, versions }.versions.join(t("ranking.and")),
              })}
            />
          </p>
          <Legend />
          <div class="halves">
            <Pareto />
            <LawCard />
          </div>
        </>
      )}
    </Page>
  );
}
