import { useEffect } from "preact/hooks";
import { titleOf } from "../../core/state/laws";
import { text } from "../../core/text/en";
import { Page } from "../../core/widgets/desk";
import { ScoreKey } from "../../core/widgets/tables";
import { COLUMNS, versionsOf } from "./columns";
import { LawCard } from "./law";
import { Radar } from "./radar";
import { measureAll, measuring, openRanking, problem, results, stopMeasuring } from "./ranking";
import { RankingTable } from "./table";

const words = text.ranking;

function Measure() {
  const now = measuring.value;
  if (now === null) {
    return (
      <button
        type="button"
        class="button"
        title={words.measureHint}
        onClick={() => void measureAll()}
      >
        {words.measure}
      </button>
    );
  }
  return (
    <div class="row">
      <span role="status">{words.measuring(titleOf(now.law), now.done, now.of)}</span>
      <progress value={now.done} max={now.of} aria-label={words.measure} />
      <button type="button" class="button" onClick={stopMeasuring}>
        {words.stop}
      </button>
    </div>
  );
}

/** Which colour of the score's bar is which of its parts. */
function ScoreParts() {
  return (
    <span class="row ranking-parts">
      {words.columns.score.name}:
      <ScoreKey names={words.parts} />
    </span>
  );
}

/** What every column was measured on. */
function Legend() {
  return (
    <details class="surface card ranking-legend">
      <summary>{words.legend}</summary>
      <dl>
        {COLUMNS.map(({ key }) => (
          <div key={key}>
            <dt>{words.columns[key].name}</dt>
            <dd class="muted">{words.columns[key].hint}</dd>
          </div>
        ))}
      </dl>
    </details>
  );
}

/** Every law on the same plant, limits, noise and loads. */
export function RankingPage() {
  useEffect(() => {
    void openRanking();
    return stopMeasuring;
  }, []);
  const found = results.value;
  return (
    <Page
      title={words.title}
      lead={words.lead}
      problem={problem.value}
      aside={found && <Measure />}
    >
      {found === null ? (
        problem.value === "" && <p class="hint">{words.loading}</p>
      ) : (
        <>
          <RankingTable />
          <p class="hint">
            <ScoreParts />
            {words.bars} {words.provenance(versionsOf(found.rows), found.suite)}
          </p>
          <Legend />
          <div class="halves">
            <Radar />
            <LawCard />
          </div>
        </>
      )}
    </Page>
  );
}
