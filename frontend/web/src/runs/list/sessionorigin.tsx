import { useEffect, useState } from "preact/hooks";
import { readRun } from "../../core/api/runs";
import type { RunDetails } from "../../core/api/types";
import { text } from "../../core/text/en";
import { OriginLink } from "./originlink";

/** The recorded run that the page's session goes on from, as far as it can still be read. */
export function SessionOrigin({ runId, tick }: { runId: string; tick: number }) {
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
