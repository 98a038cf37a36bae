import { useEffect } from "preact/hooks";
import { type Study, tableOf } from "../../core/api/studies";
import { isJobRunning, JobProgress } from "../../core/jobs/progress";
import { mayCall } from "../../core/state/access";
import { titleOf } from "../../core/state/laws";
import { t } from "../../core/text/t";
import { Example, PageWithForm } from "../../core/widgets/pagelayout";
import { Popup } from "../../core/widgets/popup";
import { ResultMenu } from "../campaign/resultmenu";
import { Distribution } from "./distribution";
import { brushedCount } from "./drawnrows";
import { SuccessMap } from "./map";
import { Scatter } from "./scatter";
import { SelectedRun } from "./selectedrun";
import {
  brush,
  chosenName,
  EVERY_LAW,
  list,
  setBrush,
  setView,
  shownLaw,
  study,
} from "./selection";
import { Start } from "./start";
import {
  attempt,
  cancel,
  follow,
  isBusy,
  leave,
  openList,
  problem,
  remove,
  rows,
  startNewStudy,
} from "./studies";
import { LawTable, Sensitivity } from "./tables";

function SavedStudies() {
  return (
    <ResultMenu
      title={t("studies.kept")}
      loading={list.value === null && problem.value === "" && t("studies.loading")}
      shown={chosenName.value}
      results={(list.value?.saved ?? []).map((saved) => ({
        key: saved.name,
        to: { kind: "studies", study: saved.name, look: {} },
        title: saved.title,
        name: saved.name,
        isExample: saved.is_example,
        state: [
          t("studies.state", { done: saved.done, rows: saved.rows }),
          ...(saved.job && isJobRunning(saved.job) ? [t(`jobs.status.${saved.job.status}`)] : []),
        ].join(", "),
      }))}
    />
  );
}

/** Progress of a study, and its commands. */
function Progress({ shownStudy }: { shownStudy: Study }) {
  const { job } = shownStudy;
  return (
    <JobProgress
      job={job}
      done={t("studies.state", { done: shownStudy.done, rows: shownStudy.rows })}
      total={shownStudy.rows}
      label={t("studies.progress", { name: shownStudy.name })}
      onCancel={() => void cancel()}
    >
      {shownStudy.done < shownStudy.rows && (
        <button
          type="button"
          class="button"
          title={t("studies.goOnHint")}
          disabled={isBusy.value !== ""}
          onClick={() => void attempt(() => startNewStudy({ source: shownStudy.name }))}
        >
          {t("studies.goOn")}
        </button>
      )}
      {shownStudy.done > 0 && (
        <a class="button" href={tableOf(shownStudy.name)} download title={t("studies.tableHint")}>
          {t("studies.table")}
        </a>
      )}
    </JobProgress>
  );
}

/** Delete after confirmation: the rows cannot be restored. */
function Deletion({ shownStudy }: { shownStudy: Study }) {
  const isGone = isBusy.value === "delete";
  return (
    <Popup
      class="button"
      title={t("studies.deleteHint")}
      button={isGone ? t("studies.deleting") : t("studies.delete")}
      isDisabled={isBusy.value !== ""}
    >
      {(close) => (
        <>
          <p>{t("studies.deleteSure", { name: shownStudy.name, done: shownStudy.done })}</p>
          <button
            type="button"
            class="button"
            onClick={() => {
              close();
              void remove(shownStudy.name);
            }}
          >
            {t("studies.deleteNow")}
          </button>
        </>
      )}
    </Popup>
  );
}

function StudyView({ shownStudy }: { shownStudy: Study }) {
  const { count, total } = rows.value;
  return (
    <div class="halves">
      <div class="surface card wide">
        <div class="spread">
          <h3>
            {shownStudy.is_example && <Example />} {shownStudy.title}
          </h3>
          {!shownStudy.is_example && mayCall("delete", "/studies/{study}") && (
            <Deletion shownStudy={shownStudy} />
          )}
        </div>
        <Progress shownStudy={shownStudy} />
        {count > 0 && (
          <p class="row">
            <span class="muted">{t("studies.marks")}</span>{" "}
            <b>
              {brushedCount.value === count
                ? t("studies.allRuns", { total: count })
                : t("studies.brushed", { brushed: brushedCount.value, total: count })}
            </b>
            <label>
              <span class="muted rigid">{t("studies.shown")}</span>
              <select
                value={shownLaw.value || EVERY_LAW}
                onChange={(event) => setView({ law: event.currentTarget.value })}
              >
                {shownStudy.laws.map((law) => (
                  <option key={law} value={law}>
                    {titleOf(law)}
                  </option>
                ))}
                <option value={EVERY_LAW}>{t("studies.everyLaw")}</option>
              </select>
            </label>
            {brush.value && (
              <button type="button" class="button" onClick={() => setBrush(null)}>
                {t("studies.clear")}
              </button>
            )}
          </p>
        )}
        {total > count && <p class="hint">{t("studies.thinned", { shown: count, total })}</p>}
      </div>
      {count === 0 ? (
        <p class="hint wide">
          {shownStudy.done === 0 ? t("studies.empty") : t("studies.loadingRuns")}
        </p>
      ) : (
        <>
          <LawTable />
          <Scatter plane="s" />
          <Scatter plane="t" />
          <SuccessMap />
          <Distribution />
          <Sensitivity />
          <SelectedRun />
        </>
      )}
    </div>
  );
}

/** Many runs with varied settings: start, follow, explore, and open single runs. */
export function StudiesPage() {
  const name = chosenName.value;
  useEffect(() => {
    void openList();
  }, []);
  useEffect(() => {
    void follow(name);
    return () => leave(name);
  }, [name]);
  const shownStudy = study.value;
  return (
    <PageWithForm
      title={t("studies.title")}
      lead={t("studies.lead")}
      problem={problem.value}
      side={
        <>
          <SavedStudies />
          <Start />
        </>
      }
    >
      {shownStudy === null ? (
        <p class="hint">{problem.value === "" && t("studies.loading")}</p>
      ) : (
        <StudyView shownStudy={shownStudy} />
      )}
    </PageWithForm>
  );
}
