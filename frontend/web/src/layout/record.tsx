import type { SessionState } from "../core/api/types";
import { toggleRecording } from "../core/state/commands";
import { mayCommand, takesCommands } from "../core/state/control";
import { isLive } from "../core/state/session";
import { text } from "../core/text/en";
import { formatSeconds } from "../core/units";

/** Begins and ends a recording, and tells how long it is. */
export function RecordButton({ state }: { state: SessionState }) {
  const { recording, rate_hz: rateHz } = state;
  if (!isLive.value) {
    return (
      <button type="button" class="button record" disabled>
        <span class="record-dot" aria-hidden="true" />
        {recording === null ? text.recording.start : text.recording.unknown}
      </button>
    );
  }
  if (recording?.state !== "recording") {
    return (
      <button
        type="button"
        class="button record"
        disabled={recording !== null || !takesCommands.value}
        title={text.recording.startHint}
        aria-keyshortcuts="r"
        onClick={() => void toggleRecording(state)}
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
      disabled={!mayCommand.value}
      title={text.recording.stop}
      aria-keyshortcuts="r"
      onClick={() => void toggleRecording(state)}
    >
      <span class="record-dot" aria-hidden="true" />
      <span class="record-word">{text.recording.running}</span>{" "}
      {formatSeconds(recording.ticks / rateHz)}
      <span class="visually-hidden">{text.recording.stop}</span>
    </button>
  );
}
