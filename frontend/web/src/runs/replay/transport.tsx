import { useSignalEffect } from "@preact/signals";
import { useRef } from "preact/hooks";
import { text } from "../../core/text/replay";
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

const { transport } = text;
const ZOOM_FACTOR = 0.5;

function Scrubber({ recording: { run, endS } }: { recording: Recording }) {
  const input = useRef<HTMLInputElement>(null);
  const output = useRef<HTMLOutputElement>(null);
  useSignalEffect(() => {
    const seconds = transport.seconds(timeS.value);
    if (output.current) output.current.textContent = seconds;
    if (input.current === null) return;
    input.current.value = String(timeS.value);
    input.current.setAttribute("aria-valuetext", seconds);
    input.current.style.setProperty("--done", String(endS > 0 ? timeS.value / endS : 0));
  });
  return (
    <>
      <div class="number time">
        <output ref={output} aria-label={transport.time} />
        <span>{transport.of(transport.seconds(endS))}</span>
      </div>
      <div class="scrubber">
        <input
          ref={input}
          type="range"
          min={0}
          max={endS}
          step={run.period_s}
          aria-label={transport.time}
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
    <section class="bar is-foot transport" aria-label={transport.heading}>
      <button
        type="button"
        class="button is-primary play"
        title={transport.keys}
        onClick={togglePlay}
      >
        <svg viewBox="0 0 12 12" aria-hidden="true">
          <path d={isPlaying.value ? "M2 1h3v10H2zM7 1h3v10H7z" : "M2 1l9 5-9 5z"} />
        </svg>
        {isPlaying.value ? transport.pause : transport.play}
      </button>
      <Scrubber recording={recording} />
      <label class="row">
        <span class="hint">{transport.speed}</span>
        <select
          value={String(speed.value)}
          onChange={(event) => {
            speed.value = Number(event.currentTarget.value);
          }}
        >
          {SPEEDS.map((factor) => (
            <option key={factor} value={String(factor)}>
              {transport.times(factor)}
            </option>
          ))}
        </select>
      </label>
      <div class="row">
        <button
          type="button"
          class="button is-icon"
          aria-label={transport.zoomIn}
          title={transport.zoomIn}
          onClick={() => zoom(ZOOM_FACTOR)}
        >
          +
        </button>
        <button
          type="button"
          class="button is-icon"
          aria-label={transport.zoomOut}
          title={transport.zoomOut}
          disabled={isWholeRun(range.value)}
          onClick={() => zoom(1 / ZOOM_FACTOR)}
        >
          −
        </button>
        <button
          type="button"
          class="button"
          title={transport.wholeHint}
          disabled={isWholeRun(range.value)}
          onClick={showAll}
        >
          {transport.whole}
        </button>
      </div>
    </section>
  );
}
