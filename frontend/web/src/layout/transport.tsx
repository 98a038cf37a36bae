import { useState } from "preact/hooks";
import { putSpeed, reset, runFigure, step } from "../core/api/client";
import type { Figure, SessionState, Speed } from "../core/api/types";
import { perform } from "../core/state/actions";
import { toggleRecording, toggleRun } from "../core/state/commands";
import { mayCommand, takesCommands } from "../core/state/control";
import { isLive } from "../core/state/session";
import { t } from "../core/text/t";
import { formatSeconds } from "../core/units";

const FIGURES: readonly Figure[] = ["4a", "4b", "5"];
const SPEEDS = [0.05, 0.1, 0.25, 0.5, 1, 2, 5];
const RUN = "M2 1l9 5-9 5z";
const PAUSE = "M2 1h3v10H2zM7 1h3v10H7z";
const STEPS_MS = [1, 10, 100, 1000];

/** A figure runs with the lanes and effects that the user has selected. */
function run(figure: Figure, { bench, configuration }: SessionState) {
  const { law, comparisons, effects, effects_preset: preset } = configuration;
  if (bench !== null) return runFigure(figure, law, {});
  return runFigure(figure, law, {
    ...(comparisons.length > 0 && { comparisons }),
    ...(preset !== "ideal" && { effects }),
  });
}

/** Only the first figure shows the word. */
function FigureName({ figure }: { figure: Figure }) {
  const [word, number] = t(`figures.name.${figure}`).split(" ");
  return (
    <span>
      <span class={figure === FIGURES[0] ? "" : "visually-hidden"}>{word} </span>
      {number}
    </span>
  );
}

export function FigurePicker({ state }: { state: SessionState }) {
  return (
    <fieldset class="line tight" disabled={!takesCommands.value} aria-label={t("figures.heading")}>
      <span class="hint roomy">{t("figures.heading")}</span>
      {FIGURES.map((figure) => (
        <button
          key={figure}
          type="button"
          class="button"
          title={t(`figures.does.${figure}`)}
          onClick={() => void perform("session", run(figure, state))}
        >
          <FigureName figure={figure} />
        </button>
      ))}
    </fieldset>
  );
}

function SpeedPicker({ speed }: { speed: Speed }) {
  const isListed = speed === "max" || SPEEDS.includes(speed);
  const speeds = isListed ? SPEEDS : [...SPEEDS, speed].sort((a, b) => a - b);
  return (
    <label class="line tight" title={t("transport.speedHint")}>
      <span class="hint roomy">{t("transport.speed")}</span>
      <select
        disabled={!mayCommand.value}
        value={String(speed)}
        onChange={(event) => {
          const chosen = event.currentTarget.value;
          const factor = chosen === "max" ? chosen : Number(chosen);
          void perform("session", putSpeed(factor));
        }}
      >
        {speeds.map((factor) => (
          <option key={factor} value={String(factor)}>
            {t("transport.times", { factor })}
          </option>
        ))}
        <option value="max">{t("transport.fastest")}</option>
      </select>
    </label>
  );
}

function Stepper({ state }: { state: SessionState }) {
  const [stepMs, setStepMs] = useState(10);
  const isReady = state.status === "paused" && mayCommand.value;
  const ticks = Math.max(1, Math.round((stepMs / 1000) * state.rate_hz));
  return (
    <div class="line tight">
      <button
        type="button"
        class="button"
        disabled={!isReady}
        title={t("transport.stepHint")}
        onClick={() => void perform("session", step(ticks))}
      >
        {t("transport.step")}
      </button>
      <select
        aria-label={t("transport.stepLength")}
        disabled={!isReady}
        value={String(stepMs)}
        onChange={(event) => setStepMs(Number(event.currentTarget.value))}
      >
        {STEPS_MS.map((ms) => (
          <option key={ms} value={String(ms)}>
            {ms < 1000
              ? t("transport.milliseconds", { ms })
              : t("transport.seconds", { seconds: ms / 1000 })}
          </option>
        ))}
      </select>
    </div>
  );
}

/** Step and speed are shown while the session is paused, or with all controls. */
export function Transport({ state, isBasic }: { state: SessionState; isBasic: boolean }) {
  const isRunning = state.status === "running";
  const action = isRunning ? t("transport.pause") : t("transport.run");
  return (
    <fieldset class="line tight transport" aria-label={t("transport.heading")}>
      <button
        type="button"
        class="button is-primary"
        disabled={state.status === "fault" || !(isRunning || mayCommand.value)}
        aria-keyshortcuts="Space"
        onClick={() => void toggleRun(state)}
      >
        {isLive.value ? (
          <>
            <svg viewBox="0 0 12 12" aria-hidden="true">
              <path d={isRunning ? PAUSE : RUN} />
            </svg>
            {action}
          </>
        ) : (
          <>
            <svg viewBox="0 0 24 12" aria-hidden="true">
              <path d={`${RUN}M14 1h3v10h-3zM19 1h3v10h-3z`} />
            </svg>
            <span class="visually-hidden">{t("transport.either")}</span>
          </>
        )}
      </button>
      <button
        type="button"
        class="button"
        disabled={!mayCommand.value}
        title={t("transport.resetHint")}
        onClick={() => void perform("session", reset)}
      >
        {t("transport.reset")}
      </button>
      {(!isBasic || state.status === "paused") && <Stepper state={state} />}
      {(!isBasic || state.status === "paused" || state.speed !== 1) && (
        <SpeedPicker speed={state.speed} />
      )}
    </fieldset>
  );
}

/** Start and stop a recording, and show its length. */
export function RecordButton({ state }: { state: SessionState }) {
  const { recording, rate_hz: rateHz } = state;
  if (!isLive.value) {
    return (
      <button type="button" class="button record" disabled>
        <span class="dot" aria-hidden="true" />
        {recording === null ? t("recording.start") : t("recording.unknown")}
      </button>
    );
  }
  if (recording?.state !== "recording") {
    return (
      <button
        type="button"
        class="button record"
        disabled={recording !== null || !takesCommands.value}
        title={t("recording.startHint")}
        aria-keyshortcuts="r"
        onClick={() => void toggleRecording(state)}
      >
        <span class="dot" aria-hidden="true" />
        {t("recording.start")}
      </button>
    );
  }
  return (
    <button
      type="button"
      class="button record is-recording"
      disabled={!mayCommand.value}
      title={t("recording.stop")}
      aria-keyshortcuts="r"
      onClick={() => void toggleRecording(state)}
    >
      <span class="dot" aria-hidden="true" />
      <span class="roomy">{t("recording.running")}</span> {formatSeconds(recording.ticks / rateHz)}
      <span class="visually-hidden">{t("recording.stop")}</span>
    </button>
  );
}
