import { useId } from "preact/hooks";
import { text } from "../../core/text/en";
import { formatInput } from "../../core/units";
import { NumberInput } from "../../core/widgets/numberinput";
import { positionOf, type SliderRange, STEPS, valueAt } from "../../core/widgets/scale";
import { draft, type Group, setDraftObserver, setDraftPoles } from "./draft";
import { allAt, areTogether, BANDWIDTH_BOUNDS, bandwidthOf } from "./poles";

const words = text.design;
const POLES: SliderRange = { min: 5, max: 200, logarithmic: true };
const OBSERVER: SliderRange = { min: 2, max: 300, logarithmic: true };

interface RowProps {
  look: string;
  label: string;
  name: string;
  note: string;
  value: number;
  range: SliderRange;
  onTry: (value: number) => void;
}

/** One bandwidth for all poles of a group; predicted at once, applied later. */
function Row({ look, label, name, note, value, range, onTry }: RowProps) {
  const id = useId();
  return (
    <div class={`small bandwidth is-${look}`}>
      <label for={id}>
        <span aria-hidden="true">{label}</span>
        <span class="visually-hidden">{name}</span>
      </label>
      <input
        type="range"
        min={0}
        max={STEPS}
        value={positionOf(value, range)}
        aria-label={text.controls.slider(name)}
        aria-valuetext={`${formatInput(value, 3)} ${words.unit}`}
        onInput={(event) =>
          onTry(Number(formatInput(valueAt(event.currentTarget.valueAsNumber, range), 3)))
        }
      />
      <NumberInput
        id={id}
        label={name}
        value={value}
        digits={4}
        unit={words.unit}
        {...BANDWIDTH_BOUNDS}
        describedBy={`${id}-note`}
        onInput={onTry}
      />
      <span class="unit clip" id={`${id}-note`}>
        {note}
      </span>
    </div>
  );
}

function PolesRow({ group }: { group: Group }) {
  const poles = draft.value?.[group] ?? [];
  return (
    <Row
      look={group}
      label={words[group]}
      name={words.bandwidth(words[group])}
      note={areTogether(poles) ? words.unit : words.mean}
      value={bandwidthOf(poles)}
      range={POLES}
      onTry={(value) => setDraftPoles(group, allAt(poles.length, value))}
    />
  );
}

export function Bandwidths() {
  const observer = draft.value?.observer;
  if (observer === undefined) return null;
  const isSpread = observer.some((beta) => beta !== observer[0]);
  return (
    <div class="bandwidths">
      <PolesRow group="position" />
      <PolesRow group="stiffness" />
      <Row
        look="observer"
        label={`${words.observer} β`}
        name={words.observerBandwidth}
        note={isSpread ? observer.map((beta) => formatInput(beta, 3)).join(", ") : words.unit}
        value={observer[0]}
        range={OBSERVER}
        onTry={setDraftObserver}
      />
    </div>
  );
}
