import { useId } from "preact/hooks";
import type { SessionState } from "../api/types";
import { inkOf } from "../plots/inks";
import { Swatch } from "../plots/legend";
import { CONTROL, compareWith, toggleCompare } from "../state/commands";
import { rivalsOf } from "../state/lanes";
import { otherLaw, titleOf, usableLaws } from "../state/laws";
import { text } from "../text/en";
import { Problem } from "../widgets/problem";

/** Another law beside the session's own, switched on and off; of several others, which one. */
export function Compare({ state }: { state: SessionState }) {
  const { law } = state.configuration;
  const rivals = rivalsOf(state);
  const id = useId();
  const isOn = rivals.length > 0;
  const isRecording = state.recording !== null;
  const rival = rivals[0]?.law ?? otherLaw(law);
  const others = usableLaws.value.filter(({ name }) => name !== law || name === rival);
  if (rival === undefined) return null;
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
        <span class="compare-words">{text.compare.with(titleOf(rival))}</span>
        {present && <Swatch look={inkOf(present.ink)} />}
      </button>
      {isOn && rivals.length === 1 && others.length > 1 && (
        <div class="compare-law">
          <select
            aria-label={text.compare.law}
            disabled={isRecording}
            value={rival}
            onChange={(event) => void compareWith(event.currentTarget.value)}
          >
            {others.map(({ name, title }) => (
              <option key={name} value={name}>
                {title}
              </option>
            ))}
          </select>
        </div>
      )}
      <span class="visually-hidden" id={id}>
        {isRecording ? text.compare.whileRecording : text.compare.does}
      </span>
      <Problem control={CONTROL.compare} />
    </>
  );
}
