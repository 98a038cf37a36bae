import { useId } from "preact/hooks";
import { text } from "../../core/text/en";
import { formatInput } from "../../core/units";
import { Problem } from "../../core/widgets/form";
import { positionOf, type SliderRange, STEPS, valueAt } from "../../core/widgets/scale";
import { MathSymbol } from "../../core/widgets/symbol";
import { type ServerNumber, useDraft } from "./draft";

interface FieldProps extends ServerNumber {
  label: string;
  /** Extends the label for screen readers if the label is clear only within its group. */
  labelRest?: string;
  unit: string;
  /** Factor from the server's value to the value on screen. */
  factor?: number;
  /** In the unit on screen. */
  range?: SliderRange;
}

/**
 * A number with its label and unit. Moving the slider makes a draft, releasing it sends it; a
 * rejection is shown below.
 */
export function Field({ label, labelRest, unit, factor = 1, range, ...serverNumber }: FieldProps) {
  const id = useId();
  const { shown, setDraft, commit, inputProps } = useDraft({
    name: serverNumber.name,
    value: serverNumber.value * factor,
    send: (value) => serverNumber.send(value / factor),
  });
  const fromSlider = (event: Event) =>
    formatInput(valueAt((event.target as HTMLInputElement).valueAsNumber, range as SliderRange), 3);

  return (
    <div class={`field ${range ? "" : "is-plain"}`}>
      <label for={id}>
        <MathSymbol text={label} />
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
      <input id={id} aria-describedby={`${id}-unit ${id}-problem`} {...inputProps} />
      <span class="unit" id={`${id}-unit`}>
        {unit}
      </span>
      <Problem id={`${id}-problem`} control={serverNumber.name} />
    </div>
  );
}
