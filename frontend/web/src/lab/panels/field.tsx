import { useId } from "preact/hooks";
import { text } from "../../core/text/en";
import { formatInput } from "../../core/units";
import { Problem } from "../../core/widgets/form";
import { positionOf, type SliderRange, STEPS, valueAt } from "../../core/widgets/scale";
import { MathSymbol } from "../../core/widgets/symbol";
import { type HeldNumber, useDraft } from "./draft";

interface FieldProps extends HeldNumber {
  label: string;
  /** Goes on where the group makes the label clear to the eye, but not to a screen reader. */
  labelRest?: string;
  unit: string;
  /** What is shown over what is held and sent. */
  factor?: number;
  /** In the unit on screen. */
  range?: SliderRange;
}

/**
 * A number with its label and unit. Moving the slider makes a draft, releasing it sends it; below
 * stands why a draft was refused.
 */
export function Field({ label, labelRest, unit, factor = 1, range, ...held }: FieldProps) {
  const id = useId();
  const { shown, setDraft, commit, inputProps } = useDraft({
    name: held.name,
    value: held.value * factor,
    send: (value) => held.send(value / factor),
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
      <Problem id={`${id}-problem`} control={held.name} />
    </div>
  );
}
