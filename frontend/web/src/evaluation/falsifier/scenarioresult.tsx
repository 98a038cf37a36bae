import { useState } from "preact/hooks";
import { type Scenario, scenarioFileOf, searchFileOf } from "../../core/api/falsifications";
import { isJobRunning, JobProgress } from "../../core/jobs/progress";
import { formatShare } from "../../core/quantities";
import { titleOf } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { formatNumber } from "../../core/units";
import { Example } from "../../core/widgets/pagelayout";
import { copyText } from "../../lab/script/copybutton";
import {
  cancel,
  findingOf,
  isBusy,
  savedScenario,
  saveSelection,
  search,
  selection,
} from "./falsifier";
import { shownTrace } from "./traces";

/** A link to the selection; the link to a search is valid as long as the lab runs. */
function Link() {
  const [message, setMessage] = useState("");
  const copy = async () => {
    setMessage((await copyText(location.href)) ? t("falsifier.copied") : t("falsifier.notCopied"));
  };
  return (
    <>
      <button type="button" class="button" onClick={() => void copy()}>
        {t("falsifier.copy")}
      </button>
      <span role="status">{message}</span>
    </>
  );
}

function Keep({ offered }: { offered: string }) {
  const [name, setName] = useState(offered);
  return (
    <form
      class="row"
      onSubmit={(event) => {
        event.preventDefault();
        void saveSelection(name);
      }}
    >
      <label class="form" title={t("falsifier.nameHint")}>
        <span>{t("falsifier.name")}</span>
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
        {t("falsifier.keep")}
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
          <b>
            {t("falsifier.lawOutcome", { law: titleOf(finding.law), outcome: finding.outcome })}
          </b>{" "}
          <span class="hint">
            {t("falsifier.foundAt", {
              run: finding.at_run,
              runs: finding.runs,
              seed: finding.seed,
            })}
            , {t("falsifier.lasts", { duration: formatNumber(Number(scenario.duration_s), 3) })}
          </span>
        </p>
      )}
      {finding?.neighbors && shownTrace.value?.neighborhood && (
        <p title={t("falsifier.neighborhoodHint")}>
          {t("falsifier.neighborhood", {
            failed: finding.neighbors_failed ?? 0,
            runs: finding.neighbors,
            share: formatShare(shownTrace.value.neighborhood),
          })}
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
        {savedScenario.value?.is_example && <Example />}{" "}
        {name !== "" ? `${name}: ${title}` : at?.title}
      </h3>
      {at && (
        <JobProgress
          job={at}
          done={t("falsifier.state", { done: at.done, total: at.total })}
          total={at.total}
          label={t("falsifier.progress", { law: titleOf(at.law) })}
          onCancel={() => void cancel()}
        />
      )}
      {scenario === null ? (
        <p class="hint">{isUnderWay ? t("falsifier.nothingYet") : null}</p>
      ) : (
        <>
          {at && <h4>{at.scenario ? t("falsifier.simplest") : t("falsifier.worstSoFar")}</h4>}
          <Facts scenario={scenario} />
          {at && at.steps.length > 0 && (
            <details>
              <summary>{t("falsifier.steps", { count: at.steps.length })}</summary>
              <ol class="bullets small cells">
                {at.steps.map((step, number) => (
                  <li key={`${number} ${step}`}>{step}</li>
                ))}
              </ol>
            </details>
          )}
          {!isUnderWay && (
            <div class="row divided">
              {at && <Keep key={at.id} offered={`${at.law}-${at.id.slice(0, 4)}`} />}
              <a
                class="button"
                href={name !== "" ? scenarioFileOf(name) : searchFileOf(at?.id ?? "")}
                download
              >
                {t("falsifier.file")}
              </a>
              <Link />
            </div>
          )}
          {at && <p class="hint">{isUnderWay ? t("falsifier.noProof") : t("falsifier.passing")}</p>}
        </>
      )}
    </section>
  );
}
