import { useState } from "preact/hooks";
import { type Scenario, scenarioFileOf, searchFileOf } from "../../core/api/falsifications";
import { isJobRunning, JobProgress } from "../../core/jobs/progress";
import { formatShare } from "../../core/quantities";
import { titleOf } from "../../core/state/laws";
import { text } from "../../core/text/en";
import { formatNumber } from "../../core/units";
import { Example } from "../../core/widgets/pagelayout";
import { copyText } from "../../lab/script/copybutton";
import {
  cancel,
  findingOf,
  isBusy,
  isExample,
  saveSelection,
  search,
  selection,
  shownTrace,
} from "./falsifier";

const words = text.falsifier;

/** A link to the selection; the link to a search is valid as long as the lab runs. */
function Link() {
  const [message, setMessage] = useState("");
  const copy = async () => {
    setMessage((await copyText(location.href)) ? words.copied : words.notCopied);
  };
  return (
    <>
      <button type="button" class="button" onClick={() => void copy()}>
        {words.copy}
      </button>
      <span role="status">{message}</span>
    </>
  );
}

function Keep({ offered }: { offered: string }) {
  const [name, setName] = useState(offered);
  return (
    <form
      class="row falsifier-acts"
      onSubmit={(event) => {
        event.preventDefault();
        void saveSelection(name);
      }}
    >
      <label class="form" title={words.nameHint}>
        <span>{words.name}</span>
        <input
          type="text"
          required
          maxLength={64}
          pattern="[0-9A-Za-z][0-9A-Za-z_\-]*"
          value={name}
          onInput={(event) => setName(event.currentTarget.value)}
        />
      </label>
      <button type="submit" class="button is-primary" disabled={isBusy.value !== ""}>
        {words.keep}
      </button>
    </form>
  );
}

/** The result in words: the law, the failure, the load, and the run of the search. */
function Facts({ scenario }: { scenario: Scenario }) {
  const finding = findingOf(scenario);
  const parts = shownTrace.value?.description ?? [];
  return (
    <>
      {finding && (
        <p>
          <b>{words.found(titleOf(finding.law), finding.outcome)}</b>{" "}
          <span class="hint">
            {words.foundAt(finding.at_run, finding.runs, finding.seed)},{" "}
            {words.lasts(formatNumber(Number(scenario.duration_s), 3))}
          </span>
        </p>
      )}
      {finding?.neighbors && shownTrace.value?.neighborhood && (
        <p title={words.neighborhoodHint}>
          {words.neighborhood(
            finding.neighbors_failed ?? 0,
            finding.neighbors,
            formatShare(shownTrace.value.neighborhood),
          )}
        </p>
      )}
      <ul class="bullets">
        {parts.map((part) => (
          <li key={part}>{part}</li>
        ))}
      </ul>
    </>
  );
}

/** A saved scenario, or a search with its progress and result. */
export function ScenarioResult({ scenario }: { scenario: Scenario | null }) {
  const name = selection.value.scenario;
  const at = name === "" ? search.value : null;
  const isUnderWay = isJobRunning(at);
  if (scenario === null && at === null) return null;
  const title = (scenario && findingOf(scenario)?.adversary) ?? scenario?.title ?? "";
  return (
    <section class="surface card wide" aria-label={name || at?.title}>
      <h3>
        {isExample.value && <Example />} {name !== "" ? `${name}: ${title}` : at?.title}
      </h3>
      {at && (
        <JobProgress
          job={at}
          done={words.state(at.done, at.total)}
          total={at.total}
          label={words.progress(titleOf(at.law))}
          onCancel={() => void cancel()}
        />
      )}
      {scenario === null ? (
        <p class="hint">{isUnderWay ? words.nothingYet : null}</p>
      ) : (
        <>
          {at && <h4>{at.scenario ? words.simplest : words.worstSoFar}</h4>}
          <Facts scenario={scenario} />
          {at && at.steps.length > 0 && (
            <details>
              <summary>{words.steps(at.steps.length)}</summary>
              <ol class="bullets small falsifier-steps">
                {at.steps.map((step, number) => (
                  <li key={`${number} ${step}`}>{step}</li>
                ))}
              </ol>
            </details>
          )}
          {!isUnderWay && (
            <div class="row falsifier-acts">
              {at && <Keep key={at.id} offered={`${at.law}-${at.id.slice(0, 4)}`} />}
              <a
                class="button"
                href={name !== "" ? scenarioFileOf(name) : searchFileOf(at?.id ?? "")}
                download
              >
                {words.file}
              </a>
              <Link />
            </div>
          )}
          {at && <p class="hint">{isUnderWay ? words.noProof : words.passing}</p>}
        </>
      )}
    </section>
  );
}
