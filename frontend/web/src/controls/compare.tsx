import { useId } from "preact/hooks";
import type { SessionState } from "../api/types";
import { inkOf } from "../plots/inks";
import { Swatch } from "../plots/legend";
import { CONTROL, toggleCompare } from "../state/commands";
import { otherLaw, rivalsOf } from "../state/lanes";
import { text } from "../text/en";
import { Problem } from "./problem";

/** The other law beside the session's own, switched on and off. */
export function Compare({ state }: { state: SessionState }) {
  const { law } = state.configuration;
  const rivals = rivalsOf(state);
  const id = useId();
  const isOn = rivals.length > 0;
  const isRecording = state.recording !== null;
  const rival = rivals[0]?.law ?? otherLaw(law);
  const present = state.lanes.at(-rivals.length || state.lanes.length)?.stretches.at(-1);
  return (
    <>
      <button
        type="button"
        role="switch"
        class="compare"
        aria-checked={isOn}
        aria-keyshortcuts="c"
        aria-describedby={id}
        disabled={isRecording}
        title={isRecording ? text.compare.whileRecording : text.compare.does}
        onClick={() => void toggleCompare(state)}
      >
        <span class="compare-track" aria-hidden="true" />
        <span class="compare-words">{text.compare.with(rival.toUpperCase())}</span>
        {present && <Swatch look={inkOf(present.ink)} />}
      </button>
      <span class="visually-hidden" id={id}>
        {isRecording ? text.compare.whileRecording : text.compare.does}
      </span>
      <Problem control={CONTROL.compare} />
    </>
  );
}
