import { startRecording, stopRecording } from "../api/client";
import type { SessionState } from "../api/types";
import { perform } from "../state/actions";
import { laneNames } from "../state/lanes";
import { text } from "../text/en";
import { formatSeconds } from "../units";

/** Begins and ends a recording, and tells how long it is. */
export function RecordButton({ state }: { state: SessionState }) {
  const { recording, rate_hz: rateHz } = state;
  if (recording?.state !== "recording") {
    const begin = () => startRecording(text.compare.versus(laneNames.peek()));
    return (
      <button
        type="button"
        class="button record"
        disabled={recording !== null}
        title={text.recording.startHint}
        onClick={() => void perform("session", begin)}
      >
        <span class="record-dot" aria-hidden="true" />
        {text.recording.start}
      </button>
    );
  }
  return (
    <button
      type="button"
      class="button record is-recording"
      title={text.recording.stop}
      onClick={() => void perform("session", stopRecording)}
    >
      <span class="record-dot" aria-hidden="true" />
      {text.recording.running(formatSeconds(recording.ticks / rateHz))}
      <span class="visually-hidden">{text.recording.stop}</span>
    </button>
  );
}
