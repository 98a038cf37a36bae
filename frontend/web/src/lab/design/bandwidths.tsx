import { useId } from "preact/hooks";
import { positionOf, type SliderRange, STEPS, valueAt } from "../../core/scale";
import { t } from "../../core/text/t";
import { formatInput, roundTo } from "../../core/units";
import { NumberInput } from "../../core/widgets/numberinput";
import { draft, type Group, setDraftObserver, setDraftPoles } from "./draft";
import { allAt, areTogether, BANDWIDTH_BOUNDS, bandwidthOf } from "./poles";

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
        aria-label={t("controls.slider", { label: name })}
        aria-valuetext={`${formatInput(value, 3)} ${t("design.unit")}`}
        onInput={(event) => onTry(roundTo(valueAt(event.currentTarget.valueAsNumber, range), 3))}
      />
      <NumberInput
        id={id}
        label={name}
        value={value}
        digits={4}
        unit={t("design.unit")}
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
      label={t(`design.${group}`)}
      name={t("design.bandwidth", { group: t(`design.${group}`) })}
      note={areTogether(poles) ? t("design.unit") : t("design.mean")}
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
    <div>
      <PolesRow group="position" />
      <PolesRow group="stiffness" />
      <Row
        look="observer"
        label={`${t("design.observer")} β`}
        name={t("design.observerBandwidth")}
        note={isSpread ? observer.map((beta) => formatInput(beta, 3)).join(", ") : t("design.unit")}
        value={observer[0]}
        range={OBSERVER}
        onTry={setDraftObserver}
      />
    </div>
  );
}
