import { useEffect, useState } from "preact/hooks";
import { logDownload } from "../../core/api/calls";
import { addressOf, branchRun, exportPath } from "../../core/api/runs";
import type { ExportName, RunDetails } from "../../core/api/types";
import { t } from "../../core/text/t";
import { ErrorLine } from "../../core/widgets/form";
import { Popup } from "../../core/widgets/popup";
import { CopyButton } from "../../lab/script/copybutton";
import { makeRunScript, scriptProblem } from "../../lab/script/repeat";
import { moveToTrash } from "./list";
import { goTo, linkTo } from "./place";
import { attempt, exportFile, fileExport } from "./problem";

const KINDS: readonly (ExportName | "html")[] = ["csv", "parquet", "mat", "mcap", "html"];

/** The tick of the run at a moment of the replay. */
const tickAt = (run: RunDetails, moment: number): number =>
  run.first_tick + Math.min(Math.round(moment / run.period_s), Math.max(0, run.ticks - 1));

function Branch({ run, moment }: { run: RunDetails; moment: number }) {
  const [isBusy, setBusy] = useState(false);
  if (run.plant !== "simulated") {
    return <span class="hint">{t("run.branchBench")}</span>;
  }
  const branch = async () => {
    setBusy(true);
    const session = await attempt(() => branchRun(run.id, tickAt(run, moment)));
    if (session) location.assign(`${location.pathname}?session=${session.session}`);
    else setBusy(false);
  };
  return (
    <button
      type="button"
      class="button is-primary"
      title={t("run.branchHint")}
      disabled={isBusy}
      onClick={() => void branch()}
    >
      {isBusy
        ? t("run.branching")
        : t("run.branch", { time: t("runs.seconds", { seconds: Number(moment.toFixed(2)) }) })}
    </button>
  );
}

/** Progress of a slow export, and its result. */
function MakingNote({ run }: { run: RunDetails }) {
  const now = fileExport.value?.run === run.id ? fileExport.value : null;
  const [seconds, count] = useState(0);
  const stage = now?.stage;
  useEffect(() => {
    count(0);
    if (stage !== "making") return;
    const timer = setInterval(() => count((before) => before + 1), 1000);
    return () => clearInterval(timer);
  }, [stage]);
  return (
    <span
      class={`hint block ${stage === "failed" ? "problem" : ""}`}
      aria-busy={stage === "making"}
    >
      <span role="status">
        {stage === "making" && t("run.making")}
        {stage === "saved" && t("run.made")}
        {stage === "failed" && t("run.notMade", { why: now?.message ?? "" })}
      </span>
      {stage === "making" && <span aria-live="off"> {t("run.makingFor", { seconds })}</span>}
    </span>
  );
}

function Exports({ run }: { run: RunDetails }) {
  const isMaking = fileExport.value?.stage === "making";
  return (
    <Popup class="button" title={t("run.downloadHint")} button={t("run.download")}>
      {(close) => (
        <ul class="menu">
          {KINDS.map((kind) => {
            const path = exportPath(run.id, kind);
            if (kind === "html") {
              return (
                <li key={kind}>
                  <button
                    type="button"
                    disabled={isMaking}
                    onClick={() => {
                      logDownload(path);
                      close();
                      void exportFile(run.id, path);
                    }}
                  >
                    <strong>{t(`run.kinds.${kind}.name`)}</strong>{" "}
                    <small>{t(`run.kinds.${kind}.does`)}</small>
                  </button>
                </li>
              );
            }
            return (
              <li key={kind}>
                <a
                  href={addressOf(path)}
                  download
                  onClick={() => {
                    logDownload(path);
                    close();
                  }}
                >
                  <strong>{t(`run.kinds.${kind}.name`)}</strong>{" "}
                  <small>{t(`run.kinds.${kind}.does`)}</small>
                </a>
              </li>
            );
          })}
        </ul>
      )}
    </Popup>
  );
}

/** Commands for a run, at the moment that its replay shows. */
export function RunActions({ run, moment }: { run: RunDetails; moment: number }) {
  const link = () =>
    new URL(linkTo({ kind: "run", run: run.id, timeS: moment }), location.href).href;
  const remove = async () => {
    if (await moveToTrash(run.id)) goTo({ kind: "list" });
  };
  return (
    <div class="row tabular">
      <Branch run={run} moment={moment} />
      <CopyButton read={link} hint={t("run.linkHint")}>
        {t("run.link")}
      </CopyButton>
      <CopyButton read={() => makeRunScript(run.id, run.title)} hint={t("run.scriptHint")}>
        {t("run.script")}
      </CopyButton>
      <Exports run={run} />
      <button type="button" class="button" onClick={() => void remove()}>
        {t("runs.remove")}
      </button>
      <MakingNote run={run} />
      <ErrorLine>{scriptProblem.value}</ErrorLine>
    </div>
  );
}
