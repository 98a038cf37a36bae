/** The run that a run or a private session continues. */

import { useEffect, useState } from "preact/hooks";
import { isPrivate } from "../../core/api/request";
import { readRun } from "../../core/api/runs";
import type { RunDetails, RunSummary } from "../../core/api/types";
import { SVSA } from "../../core/state/actuators";
import { phase, session } from "../../core/state/session";
import { text } from "../../core/text/en";
import { Marked } from "./marked";
import { PlaceLink } from "./place";

type Origin = NonNullable<RunSummary["branch_of"]>;

const words = text.runs;

/** The run that a branch goes on from, and the moment at which it left it. */
export function OriginLink({ origin }: { origin: Origin }) {
  const { run_id: run, title, time_s: timeS } = origin;
  const name = title ?? run;
  const at = timeS === null ? "" : words.at(words.seconds(Number(timeS.toFixed(3))));
  const message = words.branchOf(name, at);
  return (
    <span class="hint run-origin" title={message}>
      <svg viewBox="0 0 12 12" aria-hidden="true">
        <path d="M3 1v10M3 8c0-3 6-2 6-6" />
      </svg>
      <span class="visually-hidden">{words.branch} </span>
      {title === null ? (
        <Marked>{name}</Marked>
      ) : (
        <PlaceLink to={{ kind: "run", run, timeS: timeS ?? 0 }}>
          <Marked>{name}</Marked>
        </PlaceLink>
      )}{" "}
      {at}
    </span>
  );
}

/** The recorded run that the page's session goes on from, as far as it can still be read. */
function SessionOrigin({ runId, tick }: { runId: string; tick: number }) {
  const [run, setRun] = useState<RunDetails | null>(null);
  useEffect(() => {
    let isGone = false;
    readRun(runId).then(
      (answer) => {
        if (!isGone) setRun(answer);
      },
      () => undefined,
    );
    return () => {
      isGone = true;
    };
  }, [runId]);
  const title = run?.title ?? null;
  const timeS = run === null ? null : (tick - run.first_tick) * run.period_s;
  return (
    <>
      {text.private.origin} <OriginLink origin={{ run_id: runId, tick, title, time_s: timeS }} />
    </>
  );
}

/** Says that the page shows a private session, or that it has ended, and leads back. */
export function PrivateBanner() {
  if (!isPrivate) return null;
  const branch = session.value?.branch_of;
  const actuator = session.value?.actuator;
  const simulated = actuator === undefined || actuator.name === SVSA ? "" : actuator.title;
  const note = session.value?.note;
  const isEnded = phase.value === "ended";
  return (
    <aside class="row private-banner" aria-label={text.private.label}>
      <p role="status">
        <strong>{isEnded ? text.private.endedTitle : text.private.titleOf(simulated)}</strong>{" "}
        {isEnded ? text.private.endedText : text.private.text}{" "}
        {branch && <SessionOrigin runId={branch.run_id} tick={branch.tick} />}
      </p>
      {note && <p role="note">{note}</p>}
      <a class={`button ${isEnded ? "is-primary" : ""}`} href={location.pathname}>
        {text.private.back}
      </a>
    </aside>
  );
}
