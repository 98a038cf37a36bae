import { useCallback, useEffect, useRef, useState } from "preact/hooks";
import { readRun, replayAddress } from "../../core/api/runs";
import type { RunDetails, RunSummary } from "../../core/api/types";
import { t } from "../../core/text/t";
import { RunActions } from "./actions";
import { patchRun } from "./list";
import { OriginLink } from "./origin";
import { PlaceLink, storeMoment } from "./place";
import { attempt } from "./problem";
import { ReplayFrame } from "./replayframe";
import { Tags } from "./tags";
import { formatLength, formatMoment } from "./words";

interface WrittenProps {
  label: string;
  hint?: string;
  class: string;
  value: string;
  longest: number;
  /** Returns whether it was saved; an unsaved draft stays in the field. */
  onWrite: (value: string) => Promise<boolean>;
}

/** A text field that saves when it loses the focus or on Enter; Escape discards the draft. */
function Written({ label, hint, value, longest, onWrite, ...rest }: WrittenProps) {
  const [draft, setDraft] = useState<string | null>(null);
  return (
    <textarea
      rows={1}
      class={rest.class}
      aria-label={label}
      placeholder={hint}
      maxLength={longest}
      value={draft ?? value}
      onInput={(event) => setDraft(event.currentTarget.value.replace(/\s*\n\s*/g, " "))}
      onKeyDown={(event) => {
        if (event.key === "Enter") {
          event.preventDefault();
          event.currentTarget.blur();
        }
        if (event.key === "Escape") setDraft(null);
      }}
      onBlur={() => {
        if (draft === null || draft === value) setDraft(null);
        else void onWrite(draft).then((isKept) => isKept && setDraft(null));
      }}
    />
  );
}

interface AboutProps {
  run: RunDetails;
  onChanged: (run: RunSummary) => void;
}

function About({ run, onChanged }: AboutProps) {
  const readAgain = () => void readRun(run.id).then(onChanged, () => {}); // error is shown
  const write = async (patch: { name: string } | { notes: string }) => {
    const answer = await patchRun(run, patch);
    if (answer) onChanged(answer);
    else readAgain();
    return answer !== null;
  };
  return (
    <div class="run-about">
      <h2 class="visually-hidden">{run.title}</h2>
      <div class="row">
        <Written
          label={t("run.name")}
          hint={run.settings?.name || run.id}
          class="strong run-name"
          longest={200}
          value={run.name}
          onWrite={(name) => write({ name })}
        />
        <span class="hint clip">
          {formatMoment(run.created)} · <span title={t("run.lengthHint")}>{formatLength(run)}</span>
        </span>
        {run.name !== "" && run.settings && <span class="hint clip">{run.settings.name}</span>}
        {run.branch_of && <OriginLink origin={run.branch_of} />}
        {run.fault && (
          <strong class="bad small clip" title={run.fault.message}>
            ▲ {t("runs.fault", { what: run.fault.label })}
          </strong>
        )}
        <Tags run={run} onChanged={onChanged} onRefused={readAgain} />
      </div>
      {[run.message, run.note].map((line) => line !== "" && <p class="hint">{line}</p>)}
      <Written
        label={t("run.notes")}
        hint={t("run.notesHint")}
        class="block muted small"
        longest={10_000}
        value={run.notes}
        onWrite={(notes) => write({ notes })}
      />
    </div>
  );
}

/** Shown instead of a run that cannot be read; the line above contains the reason. */
function Missing() {
  return (
    <div class="empty">
      <h2>{t("run.missing")}</h2>
      <p>{t("run.missingText")}</p>
      <PlaceLink to={{ kind: "list" }} class="button is-primary">
        {t("run.toList")}
      </PlaceLink>
    </div>
  );
}

const SETTLED = 2;

/** Position of the replay; the address is updated when it rests. */
function useMoment(run: string, startS: number) {
  const [moment, setMoment] = useState(startS);
  const resting = useRef({ timeS: startS, count: 0 });
  const follow = useCallback(
    (timeS: number) => {
      const { current } = resting;
      current.count = current.timeS === timeS ? current.count + 1 : 0;
      current.timeS = timeS;
      setMoment(timeS);
      if (current.count === SETTLED) storeMoment(run, timeS);
    },
    [run],
  );
  return { moment, follow };
}

/** One run: replay, rename, branch, export. */
export function RunPage({ run: id, timeS }: { run: string; timeS: number }) {
  const [run, setRun] = useState<RunDetails | null>(null);
  const [isMissing, setMissing] = useState(false);
  const { moment, follow } = useMoment(id, timeS);
  useEffect(() => {
    let isGone = false;
    void attempt(() => readRun(id)).then((answer) => {
      if (isGone) return;
      setRun(answer);
      setMissing(answer === null);
    });
    return () => {
      isGone = true;
    };
  }, [id]);
  if (isMissing) return <Missing />;
  if (run === null) {
    return (
      <div class="bar row">
        <PlaceLink to={{ kind: "list" }} class="button">
          ← {t("run.toList")}
        </PlaceLink>
      </div>
    );
  }
  return (
    <>
      <div class="bar row">
        <PlaceLink to={{ kind: "list" }} class="button">
          ← {t("run.toList")}
        </PlaceLink>
        <About run={run} onChanged={(changed) => setRun({ ...run, ...changed })} />
        <RunActions run={run} moment={moment} />
      </div>
      {run.ticks > 0 ? (
        <ReplayFrame source={replayAddress(id)} name={run.title} startS={timeS} onMoment={follow} />
      ) : (
        <p class="empty">{t("run.noSamples")}</p>
      )}
    </>
  );
}
