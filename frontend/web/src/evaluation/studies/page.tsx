import { useEffect } from "preact/hooks";
import { type Study, tableOf } from "../../core/api/studies";
import { isJobRunning, JobProgress } from "../../core/jobs/progress";
import { mayCall } from "../../core/state/control";
import { titleOf } from "../../core/state/laws";
import { text } from "../../core/text/en";
import { Example, PageWithForm } from "../../core/widgets/pagelayout";
import { Popup } from "../../core/widgets/popup";
import { ResultMenu } from "../campaign/resultmenu";
import { Distribution } from "./distribution";
import { brushedCount } from "./drawnrows";
import { SuccessMap } from "./map";
import { Scatter } from "./scatter";
import { SelectedRun } from "./selectedrun";
import { Start } from "./start";
import {
  brush,
  cancel,
  chosenName,
  EVERY_LAW,
  follow,
  isBusy,
  leave,
  list,
  openList,
  problem,
  remove,
  rows,
  setBrush,
  setView,
  shownLaw,
  startNewStudy,
  study,
} from "./studies";
import { LawTable, Sensitivity } from "./tables";

const words = text.studies;

function SavedStudies() {
  return (
    <ResultMenu
      title={words.kept}
      loading={list.value === null && problem.value === "" && words.loading}
      shown={chosenName.value}
      results={(list.value?.saved ?? []).map((saved) => ({
        key: saved.name,
        to: { kind: "studies", study: saved.name, look: {} },
        title: saved.title,
        name: saved.name,
        isExample: saved.is_example,
        state: [
          words.state(saved.done, saved.rows),
          ...(saved.job && isJobRunning(saved.job) ? [text.jobs.status[saved.job.status]] : []),
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
      done={words.state(shownStudy.done, shownStudy.rows)}
      total={shownStudy.rows}
      label={words.progress(shownStudy.name)}
      onCancel={() => void cancel()}
    >
      {shownStudy.done < shownStudy.rows && (
        <button
          type="button"
          class="button"
          title={words.goOnHint}
          disabled={isBusy.value !== ""}
          onClick={() => void startNewStudy({ source: shownStudy.name })}
        >
          {words.goOn}
        </button>
      )}
      {shownStudy.done > 0 && (
        <a class="button" href={tableOf(shownStudy.name)} download title={words.tableHint}>
          {words.table}
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
      title={words.deleteHint}
      button={isGone ? words.deleting : words.delete}
      isDisabled={isBusy.value !== ""}
    >
      {(close) => (
        <>
          <p>{words.deleteSure(shownStudy.name, shownStudy.done)}</p>
          <button
            type="button"
            class="button"
            onClick={() => {
              close();
              void remove(shownStudy.name);
            }}
          >
            {words.deleteNow}
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
          <p class="row studies-brushed">
            <span class="muted">{words.marks}</span>{" "}
            <b>{words.brushed(brushedCount.value, count)}</b>
            <label>
              <span class="muted rigid">{words.shown}</span>
              <select
                value={shownLaw.value || EVERY_LAW}
                onChange={(event) => setView({ law: event.currentTarget.value })}
              >
                {shownStudy.laws.map((law) => (
                  <option key={law} value={law}>
                    {titleOf(law)}
                  </option>
                ))}
                <option value={EVERY_LAW}>{words.everyLaw}</option>
              </select>
            </label>
            {brush.value && (
              <button type="button" class="button" onClick={() => setBrush(null)}>
                {words.clear}
              </button>
            )}
          </p>
        )}
        {total > count && <p class="hint">{words.thinned(count, total)}</p>}
      </div>
      {count === 0 ? (
        <p class="hint wide">{shownStudy.done === 0 ? words.empty : words.loadingRuns}</p>
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
      title={words.title}
      lead={words.lead}
      problem={problem.value}
      side={
        <>
          <SavedStudies />
          <Start />
        </>
      }
    >
      {shownStudy === null ? (
        <p class="hint">{problem.value === "" && words.loading}</p>
      ) : (
        <StudyView shownStudy={shownStudy} />
      )}
    </PageWithForm>
  );
}
