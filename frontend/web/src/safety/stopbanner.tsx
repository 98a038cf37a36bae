import type { ComponentChildren } from "preact";
import { clearBench } from "../api/client";
import type { SessionState } from "../api/types";
import { isQuickStop, isStoppedSimulation } from "../bench/status";
import { Problem } from "../controls/problem";
import { perform } from "../state/actions";
import { isLive, session } from "../state/session";
import { text } from "../text/en";
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
function LatchedBench({ state }: { state: SessionState }) {
  const title = isQuickStop(state) ? text.stop.benchTitle : text.stop.faultTitle;
  return (
    <div class="banner is-stop">
      <span class="banner-sign" aria-hidden="true">
        ■
      </span>
      <div class="stop-words">
        <p role="alert">
          <strong>{title}</strong> {state.fault?.message} {text.stop.latched}
        </p>
        <ol aria-label={text.stop.goOn}>
          {text.stop.steps.map((step) => (
            <li key={step}>{step}</li>
          ))}
        </ol>
        <Problem control="bench.clear" />
      </div>
      <button
        type="button"
        class="button"
        title={text.bench.clearHint}
        disabled={!isLive.value}
        onClick={() => void perform("bench.clear", clearBench)}
      >
        {text.bench.clear}
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
      {state?.bench?.status === "fault" && <LatchedBench state={state} />}
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
