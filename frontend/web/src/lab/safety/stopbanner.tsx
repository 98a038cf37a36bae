import type { ComponentChildren } from "preact";
import { clearBench, restartBench } from "../../core/api/client";
import type { BenchState, SessionFault, SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { mayCommand } from "../../core/state/control";
import { isLive, session } from "../../core/state/session";
import { t } from "../../core/text/t";
import { Problem } from "../../core/widgets/form";
import {
  allowedCommands,
  isLoopLost,
  isNeverOpened,
  isQuickStop,
  isStoppedSimulation,
} from "../../hardware/status";
import { pressStop, type StopStage, stopState } from "./stop";

interface StopNoticeProps {
  title: string;
  words: string;
  isSimulation?: boolean;
  children?: ComponentChildren;
}

function StopNotice({ title, words, isSimulation = false, children }: StopNoticeProps) {
  return (
    <div class={`row banner is-stop ${isSimulation ? "is-simulation" : ""}`} role="alert">
      <span aria-hidden="true">■</span>
      <div class="grow">
        <p>
          <strong>{title}</strong> {words}
        </p>
        {children}
      </div>
    </div>
  );
}

/** Shown until the fault is cleared: why the bench stopped, and how to continue. */
function LatchedBench({ state, bench }: { state: SessionState; bench: BenchState }) {
  const isLost = isLoopLost(bench);
  const isClosed = isNeverOpened(bench);
  const isOfUser = isQuickStop(state);
  const stopTitle = isOfUser ? t("stop.benchTitle") : t("stop.faultTitle");
  const lostTitle = isClosed ? t("stop.closedTitle") : t("stop.lostTitle");
  const lostSteps = isClosed
    ? t("stop.closedSteps", { returnObjects: true })
    : t("stop.lostSteps", { returnObjects: true });
  return (
    <div class="row banner is-stop">
      <span aria-hidden="true">■</span>
      <div class="grow">
        <p role="alert">
          {!isLive.value && `${t("stop.lastKnown")} `}
          <strong>{isLost ? lostTitle : stopTitle}</strong> {state.fault?.message}{" "}
          {!isLost && isLive.value && t("stop.latched")}
        </p>
        {/* The steps below say what to do after a quick stop. */}
        {!isLost && !isOfUser && state.fault !== null && <FaultAdvice fault={state.fault} />}
        <ol class="row bullets" aria-label={t("stop.goOn")}>
          {(isLost ? lostSteps : t("stop.steps", { returnObjects: true })).map((step) => (
            <li key={step}>{step}</li>
          ))}
        </ol>
        <Problem control="bench.clear" />
      </div>
      <button
        type="button"
        class="button"
        title={isLost ? t("bench.restartHint") : t("bench.clearHint")}
        disabled={!mayCommand.value || (isLost && !allowedCommands(bench).restart)}
        onClick={() => void perform("bench.clear", isLost ? restartBench : clearBench)}
      >
        {isLost ? t("bench.restart") : t("bench.clear")}
      </button>
    </div>
  );
}

/** Outcome of a quick stop, of this or another page. */
export function StopBanners() {
  const { stage, message } = stopState.value;
  const state = session.value;
  return (
    <>
      {stage === "unconfirmed" && (
        <StopNotice title={t("stop.unconfirmedTitle")} words={t("stop.unconfirmedText")} />
      )}
      {stage === "refused" && (
        <StopNotice title={t("stop.refusedTitle")} words={message}>
          <p>{t("stop.refusedText")}</p>
        </StopNotice>
      )}
      {state?.bench?.status === "fault" && <LatchedBench state={state} bench={state.bench} />}
      {state !== null && isStoppedSimulation(state) && (
        <StopNotice
          title={t("stop.simulationTitle")}
          words={t("stop.simulationText")}
          isSimulation
        />
      )}
    </>
  );
}

/** What to check or try after a fault; nothing for a code that the lab does not know. */
export function FaultAdvice({ fault: { advice } }: { fault: SessionFault }) {
  if (advice === null) return null;
  return (
    <details>
      <summary>{t("fault.adviceTitle")}</summary>
      {advice}
    </details>
  );
}

const WORDS: Record<StopStage, string> = {
  idle: t("stop.button"),
  sending: t("stop.sending"),
  confirmed: t("stop.confirmed"),
  unconfirmed: t("stop.again"),
  refused: t("stop.refused"),
};

/**
 * Never disabled, whatever the state of the connection.
 *
 * If only a simulation can be running, its style is that of an ordinary button.
 */
export function StopButton() {
  const { stage } = stopState.value;
  const isSimulation = session.value?.bench === null;
  return (
    <button
      type="button"
      class={`button rigid stop-button ${isSimulation ? "is-simulation" : "is-bench"}`}
      aria-keyshortcuts="Shift+Escape"
      title={isSimulation ? t("stop.doesSimulation") : t("stop.doesBench")}
      onClick={() => void pressStop()}
    >
      <span class="stop-sign" aria-hidden="true" />
      <strong>{WORDS[stage]}</strong>
      <small>{t("stop.keys")}</small>
      {stage !== "idle" && <span class="visually-hidden">{t("stop.button")}</span>}
    </button>
  );
}
