import type { ComponentChildren } from "preact";
import { clearBench, restartBench } from "../../core/api/client";
import type { BenchState, SessionFault, SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { mayCommand } from "../../core/state/control";
import { isLive, session } from "../../core/state/session";
import { text } from "../../core/text/en";
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
      <span class="banner-sign" aria-hidden="true">
        ■
      </span>
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
  const stopTitle = isOfUser ? text.stop.benchTitle : text.stop.faultTitle;
  const lostTitle = isClosed ? text.stop.closedTitle : text.stop.lostTitle;
  const lostSteps = isClosed ? text.stop.closedSteps : text.stop.lostSteps;
  return (
    <div class="row banner is-stop">
      <span class="banner-sign" aria-hidden="true">
        ■
      </span>
      <div class="grow">
        <p role="alert">
          {!isLive.value && `${text.stop.lastKnown} `}
          <strong>{isLost ? lostTitle : stopTitle}</strong> {state.fault?.message}{" "}
          {!isLost && isLive.value && text.stop.latched}
        </p>
        {/* The steps below say what to do after a quick stop. */}
        {!isLost && !isOfUser && state.fault !== null && <FaultAdvice fault={state.fault} />}
        <ol class="row bullets" aria-label={text.stop.goOn}>
          {(isLost ? lostSteps : text.stop.steps).map((step) => (
            <li key={step}>{step}</li>
          ))}
        </ol>
        <Problem control="bench.clear" />
      </div>
      <button
        type="button"
        class="button"
        title={isLost ? text.bench.restartHint : text.bench.clearHint}
        disabled={!mayCommand.value || (isLost && !allowedCommands(bench).restart)}
        onClick={() => void perform("bench.clear", isLost ? restartBench : clearBench)}
      >
        {isLost ? text.bench.restart : text.bench.clear}
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
        <StopNotice title={text.stop.unconfirmedTitle} words={text.stop.unconfirmedText} />
      )}
      {stage === "refused" && (
        <StopNotice title={text.stop.refusedTitle} words={message}>
          <p>{text.stop.refusedText}</p>
        </StopNotice>
      )}
      {state?.bench?.status === "fault" && <LatchedBench state={state} bench={state.bench} />}
      {state !== null && isStoppedSimulation(state) && (
        <StopNotice
          title={text.stop.simulationTitle}
          words={text.stop.simulationText}
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
    <details class="fault-advice">
      <summary>{text.fault.adviceTitle}</summary>
      {advice}
    </details>
  );
}

const WORDS: Record<StopStage, string> = {
  idle: text.stop.button,
  sending: text.stop.sending,
  confirmed: text.stop.confirmed,
  unconfirmed: text.stop.again,
  refused: text.stop.refused,
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
      title={isSimulation ? text.stop.doesSimulation : text.stop.doesBench}
      onClick={() => void pressStop()}
    >
      <span class="stop-sign" aria-hidden="true" />
      <strong>{WORDS[stage]}</strong>
      <small>{text.stop.keys}</small>
      {stage !== "idle" && <span class="visually-hidden">{text.stop.button}</span>}
    </button>
  );
}
