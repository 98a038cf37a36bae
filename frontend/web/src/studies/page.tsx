import { useEffect } from "preact/hooks";
import { type Study, tableOf } from "../api/studies";
import { PlaceLink } from "../runs/placelink";
import { titleOf } from "../state/laws";
import { text } from "../text/en";
import { formatSeconds } from "../units";
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
  isGoing,
  leave,
  list,
  openList,
  problem,
  rows,
  setBrush,
  setLook,
  shownLaw,
  study,
} from "./studies";
import { LawTable, Sensitivity } from "./tables";

const words = text.studies;

function Kept() {
  const kept = list.value?.kept ?? [];
  return (
    <nav class="studies-kept" aria-label={words.kept}>
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
                {one.job && isGoing(one) && `, ${words.status[one.job.status]}`}
              </small>
            </PlaceLink>
          </li>
        ))}
      </ul>
    </nav>
  );
}

/** How far it is, how fast it goes, how long it still takes. */
function Progress({ found }: { found: Study }) {
  const { job } = found;
  const isUnderWay = isGoing(found);
  const told = [words.state(found.done, found.rows)];
  if (job && (isUnderWay || job.status !== "done")) told.push(words.status[job.status]);
  if (job?.problem) told.push(job.problem);
  if (isUnderWay && job?.status === "running") {
    told.push(job.rate_per_s === null ? words.compiling : words.rate(job.rate_per_s));
    if (job.left_s !== null) told.push(words.left(formatSeconds(job.left_s)));
  }
  return (
    <div class="studies-progress">
      <span role="status">{told.join(" · ")}</span>
      {isUnderWay && (
        <progress value={job?.done ?? 0} max={found.rows} aria-label={words.progress(found.name)} />
      )}
      {isUnderWay ? (
        <button type="button" class="button" title={words.cancelHint} onClick={() => void cancel()}>
          {words.cancel}
        </button>
      ) : (
        found.done < found.rows && (
          <button
            type="button"
            class="button"
            title={words.goOnHint}
            disabled={isBusy.value !== ""}
            onClick={() => void begin({ source: found.name })}
          >
            {words.goOn}
          </button>
        )
      )}
      {!isUnderWay && found.done > 0 && (
        <a class="button" href={tableOf(found.name)} download title={words.tableHint}>
          {words.table}
        </a>
      )}
    </div>
  );
}

function Looked({ found }: { found: Study }) {
  const { count, total } = rows.value;
  return (
    <div class="studies-looked">
      <div class="studies-card studies-wide">
        <h3>{found.title}</h3>
        <Progress found={found} />
        {count > 0 && (
          <p class="studies-brushed">
            <span>{words.marks}</span> <b>{words.brushed(brushedCount.value, count)}</b>
            <label>
              <span>{words.shown}</span>
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
        <p class="hint studies-wide">{words.empty}</p>
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
    <main class="studies" aria-label={words.title}>
      <div class="studies-head">
        <h2>{words.title}</h2>
        <p>{words.lead}</p>
      </div>
      <p class="problem" role="alert" hidden={problem.value === ""}>
        {problem.value}
      </p>
      <div class="studies-body">
        <aside class="studies-side">
          <Kept />
          <Start />
        </aside>
        {found === null ? (
          <p class="hint">{name === "" ? words.choose : problem.value === "" && words.loading}</p>
        ) : (
          <Looked found={found} />
        )}
      </div>
    </main>
  );
}
