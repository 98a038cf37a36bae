import { useId, useState } from "preact/hooks";
import { text } from "../../core/text/en";
import { formatInput } from "../../core/units";
import { positionOf, type SliderRange, STEPS, valueAt } from "../../core/widgets/scale";
import { draft, type Group, setDraftObserver, setDraftPoles } from "./draft";
import { allAt, areTogether, bandwidthOf } from "./poles";

const words = text.design;
const POLES: SliderRange = { min: 5, max: 200, logarithmic: true };
const OBSERVER: SliderRange = { min: 2, max: 300, logarithmic: true };

const MIN = 0.1;
const MAX = 1000;
const BOUNDS = text.refusal.between(String(MIN), `${MAX} ${words.unit}`);

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
  const [typed, setTyped] = useState<string | null>(null);
  const isTaken = (written: string) =>
    written.trim() !== "" && Number(written) >= MIN && Number(written) <= MAX;
  const take = (written: string) => {
    setTyped(written);
    if (isTaken(written)) onTry(Number(written));
  };
  const isRefused = typed !== null && !isTaken(typed);
  return (
    <div class={`bandwidth is-${look}`}>
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
      <input
        id={id}
        type="number"
        step="any"
        min={MIN}
        max={MAX}
        aria-invalid={isRefused}
        value={typed ?? formatInput(value, 4)}
        aria-describedby={`${id}-note`}
        onInput={(event) => take(event.currentTarget.value)}
        onBlur={() => setTyped(null)}
      />
      <span class="unit clip" id={`${id}-note`}>
        {note}
      </span>
      {isRefused && (
        <p class="problem wide" role="alert">
          {typed.trim() === ""
            ? text.refusal.noNumber
            : text.refusal.outOfRange(name, `${typed} ${words.unit}`, BOUNDS)}
        </p>
      )}
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
