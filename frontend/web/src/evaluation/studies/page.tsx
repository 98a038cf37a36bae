import { useEffect } from "preact/hooks";
import { type Study, tableOf } from "../../core/api/studies";
import { isGoing, JobProgress } from "../../core/jobs/progress";
import { isObserver } from "../../core/state/control";
import { titleOf } from "../../core/state/laws";
import { text } from "../../core/text/en";
import { Desk } from "../../core/widgets/desk";
import { Popup } from "../../core/widgets/popup";
import { PlaceLink } from "../../runs/list/place";
import { Distribution } from "./distribution";
import { SuccessMap } from "./map";
import { Picked } from "./picked";
import { Scatter } from "./scatter";
import { brushedCount } from "./shown";
import { Start } from "./start";
import {
  begin,
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
  setLook,
  shownLaw,
  study,
} from "./studies";
import { LawTable, Sensitivity } from "./tables";

const words = text.studies;

function Kept() {
  const kept = list.value?.saved ?? [];
  return (
    <nav class="surface card menu" aria-label={words.kept}>
      <h3>{words.kept}</h3>
      {list.value === null && problem.value === "" && <p class="hint">{words.loading}</p>}
      {list.value !== null && kept.length === 0 && <p class="hint">{words.none}</p>}
      <ul>
        {kept.map((one) => (
          <li key={one.name} aria-current={one.name === chosenName.value ? "page" : undefined}>
            <PlaceLink to={{ kind: "studies", study: one.name, look: {} }} title={one.title}>
              <b>{one.name}</b>
              <small>
                {words.state(one.done, one.rows)}
                {one.job && isGoing(one.job) && `, ${text.jobs.status[one.job.status]}`}
              </small>
            </PlaceLink>
          </li>
        ))}
      </ul>
    </nav>
  );
}

/** How far it is, and what can be done with it. */
function Progress({ found }: { found: Study }) {
  const { job } = found;
  return (
    <JobProgress
      job={job}
      done={words.state(found.done, found.rows)}
      total={found.rows}
      label={words.progress(found.name)}
      onCancel={() => void cancel()}
    >
      {found.done < found.rows && (
        <button
          type="button"
          class="button"
          title={words.goOnHint}
          disabled={isBusy.value !== ""}
          onClick={() => void begin({ source: found.name })}
        >
          {words.goOn}
        </button>
      )}
      {found.done > 0 && (
        <a class="button" href={tableOf(found.name)} download title={words.tableHint}>
          {words.table}
        </a>
      )}
    </JobProgress>
  );
}

/** Asks first: its rows cannot be brought back. */
function Deletion({ found }: { found: Study }) {
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
          <p>{words.deleteSure(found.name, found.done)}</p>
          <button
            type="button"
            class="button"
            onClick={() => {
              close();
              void remove(found.name);
            }}
          >
            {words.deleteNow}
          </button>
        </>
      )}
    </Popup>
  );
}

function Looked({ found }: { found: Study }) {
  const { count, total } = rows.value;
  return (
    <div class="halves">
      <div class="surface card wide">
        <div class="spread">
          <h3>{found.title}</h3>
          {!isObserver.value && <Deletion found={found} />}
        </div>
        <Progress found={found} />
        {count > 0 && (
          <p class="row studies-brushed">
            <span class="muted">{words.marks}</span>{" "}
            <b>{words.brushed(brushedCount.value, count)}</b>
            <label>
              <span class="muted">{words.shown}</span>
              <select
                value={shownLaw.value || EVERY_LAW}
                onChange={(event) => setLook({ law: event.currentTarget.value })}
              >
                {found.laws.map((law) => (
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
        <p class="hint wide">{words.empty}</p>
      ) : (
        <>
          <LawTable />
          <Scatter plane="s" />
          <Scatter plane="t" />
          <SuccessMap />
          <Distribution />
          <Sensitivity />
          <Picked />
        </>
      )}
    </div>
  );
}

/** Many runs with settings that vary: begun, followed, looked at, and seen one by one. */
export function StudiesPage() {
  const name = chosenName.value;
  useEffect(() => {
    void openList();
  }, []);
  useEffect(() => {
    void follow(name);
    return leave;
  }, [name]);
  const found = study.value;
  return (
    <Desk
      title={words.title}
      lead={words.lead}
      problem={problem.value}
      side={
        <>
          <Kept />
          <Start />
        </>
      }
    >
      {found === null ? (
        <p class="hint">{name === "" ? words.choose : problem.value === "" && words.loading}</p>
      ) : (
        <Looked found={found} />
      )}
    </Desk>
  );
}
