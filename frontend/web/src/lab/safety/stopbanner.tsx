import type { ComponentChildren } from "preact";
import { clearBench, restartBench } from "../../core/api/client";
import type { BenchState, SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { mayCommand } from "../../core/state/control";
import { isLive, session } from "../../core/state/session";
import { text } from "../../core/text/en";
import { Problem } from "../../core/widgets/problem";
import {
  allowedOn,
  isLoopLost,
  isNeverOpened,
  isQuickStop,
  isStoppedSimulation,
} from "../../hardware/status";
import { FaultAdvice } from "./advice";
import { stop } from "./stop";

interface StopNoticeProps {
  title: string;
  words: string;
  isSimulation?: boolean;
  children?: ComponentChildren;
}

function StopNotice({ title, words, isSimulation = false, children }: StopNoticeProps) {
  return (
    <div class={`banner is-stop ${isSimulation ? "is-simulation" : ""}`} role="alert">
      <span class="banner-sign" aria-hidden="true">
        ■
      </span>
      <div class="stop-words">
        <p>
          <strong>{title}</strong> {words}
        </p>
        {children}
      </div>
    </div>
  );
}

/** Stays until somebody clears the fault: why it stopped, and how to go on. */
function LatchedBench({ state, bench }: { state: SessionState; bench: BenchState }) {
  const isLost = isLoopLost(bench);
  const isClosed = isNeverOpened(bench);
  const stopTitle = isQuickStop(state) ? text.stop.benchTitle : text.stop.faultTitle;
  const lostTitle = isClosed ? text.stop.closedTitle : text.stop.lostTitle;
  const lostSteps = isClosed ? text.stop.closedSteps : text.stop.lostSteps;
  return (
    <div class="banner is-stop">
      <span class="banner-sign" aria-hidden="true">
        ■
      </span>
      <div class="stop-words">
        <p role="alert">
          {!isLive.value && `${text.stop.lastKnown} `}
          <strong>{isLost ? lostTitle : stopTitle}</strong> {state.fault?.message}{" "}
          {!isLost && isLive.value && text.stop.latched}
        </p>
        {!isLost && state.fault !== null && <FaultAdvice fault={state.fault} />}
        <ol aria-label={text.stop.goOn}>
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
        disabled={!mayCommand.value || (isLost && !allowedOn(bench).restart)}
        onClick={() => void perform("bench.clear", isLost ? restartBench : clearBench)}
      >
        {isLost ? text.bench.restart : text.bench.clear}
      </button>
    </div>
  );
}

/** What became of a quick stop, of this page or of any other. */
export function StopBanners() {
  const { stage, message } = stop.value;
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
