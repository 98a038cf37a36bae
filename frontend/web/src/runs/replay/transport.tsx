import { useSignalEffect } from "@preact/signals";
import { useRef } from "preact/hooks";
import { t } from "../../core/text/t";
import { formatFixed } from "../../core/units";
import {
  isPlaying,
  isWholeRun,
  range,
  SPEEDS,
  seek,
  showAll,
  speed,
  timeS,
  togglePlay,
  zoom,
} from "./clock";
import type { Recording } from "./data";

const ZOOM_FACTOR = 0.5;

function Scrubber({ recording: { run, endS } }: { recording: Recording }) {
  const input = useRef<HTMLInputElement>(null);
  const output = useRef<HTMLOutputElement>(null);
  useSignalEffect(() => {
    const seconds = t("replay.transport.seconds", { seconds: formatFixed(timeS.value, 2) });
    if (output.current) output.current.textContent = seconds;
    if (input.current === null) return;
    input.current.value = String(timeS.value);
    input.current.setAttribute("aria-valuetext", seconds);
  });
  return (
    <>
      <div class="number nowrap time">
        <output ref={output} aria-label={t("replay.transport.time")} />
        <span>
          {t("replay.transport.of", {
            duration: t("replay.transport.seconds", { seconds: formatFixed(endS, 2) }),
          })}
        </span>
      </div>
      <div class="scrubber">
        <input
          ref={input}
          type="range"
          min={0}
          max={endS}
          step={run.period_s}
          aria-label={t("replay.transport.time")}
          onInput={(event) => {
            isPlaying.value = false;
            seek(event.currentTarget.valueAsNumber);
          }}
        />
        {run.events.map((event, index) => (
          <i
            key={`${index}.${event.label}`}
            style={{ "--at": String(event.time_s / Math.max(endS, 1e-9)) }}
            title={event.label}
          />
        ))}
      </div>
    </>
  );
}

export function Transport({ recording }: { recording: Recording }) {
  return (
    <section class="bar row is-foot transport" aria-label={t("replay.transport.heading")}>
      <button
        type="button"
        class="button is-primary play"
        title={t("replay.transport.keys")}
        onClick={togglePlay}
      >
        <svg viewBox="0 0 12 12" aria-hidden="true">
          <path d={isPlaying.value ? "M2 1h3v10H2zM7 1h3v10H7z" : "M2 1l9 5-9 5z"} />
        </svg>
        {isPlaying.value ? t("replay.transport.pause") : t("replay.transport.play")}
      </button>
      <Scrubber recording={recording} />
      <label class="row">
        <span class="hint">{t("replay.transport.speed")}</span>
        <select
          value={String(speed.value)}
          onChange={(event) => {
            speed.value = Number(event.currentTarget.value);
          }}
        >
          {SPEEDS.map((factor) => (
            <option key={factor} value={String(factor)}>
              {t("replay.transport.times", { factor })}
            </option>
          ))}
        </select>
      </label>
      <div class="row">
        <button
          type="button"
          class="button is-icon"
          aria-label={t("replay.transport.zoomIn")}
          title={t("replay.transport.zoomIn")}
          onClick={() => zoom(ZOOM_FACTOR)}
        >
          +
        </button>
        <button
          type="button"
          class="button is-icon"
          aria-label={t("replay.transport.zoomOut")}
          title={t("replay.transport.zoomOut")}
          disabled={isWholeRun(range.value)}
          onClick={() => zoom(1 / ZOOM_FACTOR)}
        >
          −
        </button>
        <button
          type="button"
          class="button"
          title={t("replay.transport.wholeHint")}
          disabled={isWholeRun(range.value)}
          onClick={showAll}
        >
          {t("replay.transport.whole")}
        </button>
      </div>
    </section>
  );
}
