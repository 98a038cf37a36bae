import { useId } from "preact/hooks";
import { t } from "../../core/text/t";
import { formatInput, roundTo } from "../../core/units";
import { Problem } from "../../core/widgets/form";
import { NumberField } from "../../core/widgets/numberinput";
import { positionOf, type SliderRange, STEPS, valueAt } from "../../core/widgets/scale";
import { type ServerNumber, useServerNumber } from "./draft";

interface FieldProps extends ServerNumber {
  label: string;
  labelRest?: string;
  unit: string;
  /** Factor from the server's value to the value on screen. */
  factor?: number;
  /** Bounds in the unit on screen. */
  min?: number | undefined;
  max?: number | undefined;
  /** Of the slider, in the unit on screen. */
  range?: SliderRange;
}

/** A number of the server. Moving the slider shows the value, releasing it sends it. */
export function Field({ name, value, send, factor = 1, range, ...field }: FieldProps) {
  const id = useId();
  const { shown, drag, commit, release, edits } = useServerNumber({
    name,
    value: value * factor,
    send: (next) => send(next / factor),
  });
  const { label, labelRest, unit } = field;
  const fromSlider = ({ currentTarget }: { currentTarget: HTMLInputElement }) =>
    roundTo(valueAt(currentTarget.valueAsNumber, range as SliderRange), 3);
  return (
    <NumberField
      {...field}
      value={shown}
      step={range?.step}
      describedBy={id}
      onCommit={commit}
      slider={
        range && (
          <input
            type="range"
            min={0}
            max={STEPS}
            value={positionOf(shown, range)}
            aria-label={t("controls.slider", {
              label: labelRest ? `${label} ${labelRest}` : label,
            })}
            aria-valuetext={`${formatInput(shown)} ${unit}`}
            aria-describedby={id}
            onInput={(event) => drag(fromSlider(event))}
            onChange={(event) => void release(fromSlider(event))}
          />
        )
      }
      below={<Problem id={id} control={name} />}
      container={edits}
    />
  );
}
