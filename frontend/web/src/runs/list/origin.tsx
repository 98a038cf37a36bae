/** The run from which a run or a private session branched. */

import { useEffect, useState } from "preact/hooks";
import { isPrivate } from "../../core/api/request";
import { readRun } from "../../core/api/runs";
import type { RunDetails, RunSummary } from "../../core/api/types";
import { SVSA } from "../../core/state/actuators";
import { isArm } from "../../core/state/arm";
import { phase, session } from "../../core/state/session";
import { t } from "../../core/text/t";
import { Highlighted } from "./highlight";
import { PlaceLink } from "./place";

type Origin = NonNullable<RunSummary["branch_of"]>;

/** The run from which a branch started, and the time of the branch. */
export function OriginLink({ origin }: { origin: Origin }) {
  const { run_id: run, title, time_s: timeS } = origin;
  const name = title ?? run;
  const at =
    timeS === null
      ? ""
      : t("runs.at", { time: t("runs.seconds", { seconds: Number(timeS.toFixed(3)) }) });
  const message = t("runs.branchOf", { name, time: at }).trim();
  return (
    <span class="hint clip grow" title={message}>
      <svg width="11" height="11" viewBox="0 0 12 12" aria-hidden="true">
        <path d="M3 1v10M3 8c0-3 6-2 6-6" fill="none" stroke="currentColor" stroke-width="1.6" />
      </svg>{" "}
      <span class="visually-hidden">{t("runs.branch")} </span>
      {title === null ? (
        <Highlighted>{name}</Highlighted>
      ) : (
        <PlaceLink to={{ kind: "run", run, timeS: timeS ?? 0 }}>
          <Highlighted>{name}</Highlighted>
        </PlaceLink>
      )}{" "}
      {at}
    </span>
  );
}

/** The recorded run from which the page's session branched, if it can still be read. */
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
      {t("private.origin")} <OriginLink origin={{ run_id: runId, tick, title, time_s: timeS }} />
    </>
  );
}

/** Reports that the page shows a private session, or that it has ended, with a link back. */
export function PrivateBanner() {
  if (!isPrivate) return null;
  const branch = session.value?.branch_of;
  const actuator = session.value?.actuator;
  const other = actuator === undefined || actuator.name === SVSA ? "" : actuator.title;
  const simulated = isArm.value ? t("arm.name") : other;
  const note = session.value?.note;
  const isEnded = phase.value === "ended";
  return (
    <aside class="row banner is-accent" aria-label={t("private.label")}>
      <p role="status">
        <strong>
          {isEnded
            ? t("private.endedTitle")
            : simulated === ""
              ? t("private.title")
              : t("private.titleOf", { actuator: simulated })}
        </strong>{" "}
        {isEnded ? t("private.endedText") : t("private.text")}{" "}
        {branch && <SessionOrigin runId={branch.run_id} tick={branch.tick} />}
      </p>
      {note && <p role="note">{note}</p>}
      <a class={`button ${isEnded ? "is-primary" : ""}`} href={location.pathname}>
        {t("private.back")}
      </a>
    </aside>
  );
}
