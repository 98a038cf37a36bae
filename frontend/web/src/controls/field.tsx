import { useId, useState } from "preact/hooks";
import type { SessionState } from "../api/types";
import { perform } from "../state/actions";
import { text } from "../text/en";
import { formatInput } from "../units";
import { Problem } from "./problem";
import { positionOf, type SliderRange, STEPS, valueAt } from "./scale";

export interface FieldProps {
  /** Names the control among all others of the page. */
  name: string;
  label: string;
  /** Goes on where the group makes the label clear to the eye, but not to a screen reader. */
  labelRest?: string;
  unit: string;
  /** What the server holds, in the unit on screen. */
  value: number;
  range?: SliderRange;
  send: (value: number) => Promise<SessionState>;
}

/**
 * A number the server holds. Moving the slider or typing makes a draft; releasing or Enter sends
 * it; then the field shows again what the server holds, and below it why a draft was refused.
 */
export function Field({ name, label, labelRest, unit, value, range, send }: FieldProps) {
  const id = useId();
  const [draft, setDraft] = useState<string | null>(null);
  const shown = draft ?? formatInput(value);

  const commit = async (next: string) => {
    const number = Number(next);
    if (next.trim() !== "" && Number.isFinite(number) && next !== formatInput(value)) {
      setDraft(next);
      await perform(name, () => send(number));
    }
    setDraft((current) => (current === null || current === next ? null : current));
  };
  const fromSlider = (event: Event) =>
    formatInput(valueAt((event.target as HTMLInputElement).valueAsNumber, range as SliderRange), 3);

  return (
    <div class={`field ${range ? "" : "is-plain"}`}>
      <label for={id}>
        {label}
        {labelRest && <span class="visually-hidden"> {labelRest}</span>}
      </label>
      {range && (
        <input
          type="range"
          min={0}
          max={STEPS}
          value={positionOf(Number(shown), range)}
          aria-label={text.controls.slider(labelRest ? `${label} ${labelRest}` : label)}
          aria-valuetext={`${shown} ${unit}`}
          aria-describedby={`${id}-problem`}
          onInput={(event) => setDraft(fromSlider(event))}
          onChange={(event) => void commit(fromSlider(event))}
        />
      )}
      <input
        id={id}
        type="number"
        step="any"
        value={shown}
        aria-describedby={`${id}-unit ${id}-problem`}
        onInput={(event) => setDraft(event.currentTarget.value)}
        onChange={(event) => void commit(event.currentTarget.value)}
        onBlur={() => setDraft(null)}
        onKeyDown={(event) => {
          if (event.key === "Escape") setDraft(null);
        }}
      />
      <span class="unit" id={`${id}-unit`}>
        {unit}
      </span>
      <Problem id={`${id}-problem`} control={name} />
    </div>
  );
}
