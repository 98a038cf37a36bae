import { useEffect } from "preact/hooks";
import { text } from "../../core/text/en";
import { Page } from "../../core/widgets/pagelayout";
import { MathSymbol } from "../../core/widgets/symbol";
import { COLUMNS } from "./columns";
import { LawCard } from "./law";
import { Pareto } from "./pareto";
import { openRanking, problem, results } from "./ranking";
import { RankingTable } from "./table";

const words = text.ranking;

/** Conditions of all measurements. */
function Legend() {
  return (
    <details class="surface card">
      <summary>{words.legend}</summary>
      <dl class="cells" style={{ "--cell": "320px" }}>
        {COLUMNS.map(({ key }) => (
          <div key={key}>
            <dt class="strong">{words.columns[key].name}</dt>
            <dd class="muted">{words.columns[key].hint}</dd>
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
    <Page title={words.title} lead={words.lead} problem={problem.value}>
      {ranking === null ? (
        problem.value === "" && <p class="hint">{words.loading}</p>
      ) : (
        <>
          <RankingTable />
          <p class="hint">
            <MathSymbol text={words.provenance({ ...ranking, versions })} />
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
