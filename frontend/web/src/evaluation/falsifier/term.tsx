import { t } from "../../core/text/t";
import { SelectField } from "../../core/widgets/form";
import { NumberField } from "../../core/widgets/numberinput";
import { BODIES, changeKind, KINDS, type TermForm } from "./definition";

interface RangeProps {
  label: string;
  unit: string;
  ends: readonly [number, number];
  onChange: (ends: readonly [number, number]) => void;
}

function Range({ label, unit, ends, onChange }: RangeProps) {
  return (
    <div class="pair">
      <NumberField
        label={label}
        unit={unit}
        min={0}
        value={ends[0]}
        onInput={(from) => onChange([from, ends[1]])}
      />
      <NumberField
        label={t("falsifier.to")}
        unit={unit}
        min={0}
        value={ends[1]}
        onInput={(to) => onChange([ends[0], to])}
      />
    </div>
  );
}

interface TermFieldsProps {
  number: number;
  term: TermForm;
  canBeRemoved: boolean;
  onChange: (term: TermForm) => void;
  onRemove: () => void;
}

/** One load of the family: kind, channels, size, onset, and duration or frequency. */
export function TermFields({ number, term, canBeRemoved, onChange, onRemove }: TermFieldsProps) {
  return (
    <fieldset class="stack sunken falsifier-term">
      <legend>{t("falsifier.load", { number })}</legend>
      <div class="pair">
        <SelectField
          label={t("falsifier.kind")}
          value={term.kind}
          options={KINDS}
          name={(kind) => t(`falsifier.kinds.${kind}`)}
          onChoose={(kind) => onChange(changeKind(term, kind))}
        />
        <NumberField
          label={t("falsifier.torque")}
          unit="N·m"
          min={0}
          max={50}
          value={term.torqueNm}
          onInput={(torqueNm) => onChange({ ...term, torqueNm })}
        />
      </div>
      <p class="row">
        <span class="hint">{t("falsifier.onBodies")}</span>
        {BODIES.map((body) => {
          const others = term.bodies.filter((other) => other !== body);
          const isOn = others.length < term.bodies.length;
          return (
            <label key={body}>
              <input
                type="checkbox"
                checked={isOn}
                disabled={isOn && others.length === 0}
                onChange={() => onChange({ ...term, bodies: isOn ? others : [...others, body] })}
              />{" "}
              {t(`falsifier.bodies.${body}`)}
            </label>
          );
        })}
      </p>
      <Range
        label={t("falsifier.onsetFrom")}
        unit="s"
        ends={term.startS}
        onChange={(startS) => onChange({ ...term, startS })}
      />
      {term.kind !== "step" && (
        <Range
          label={t(`falsifier.ownFrom.${term.kind}`)}
          unit={term.kind === "sine" ? "Hz" : "s"}
          ends={term.own}
          onChange={(own) => onChange({ ...term, own })}
        />
      )}
      {canBeRemoved && (
        <button
          type="button"
          class="button"
          aria-label={t("falsifier.removeLabel", { number })}
          onClick={onRemove}
        >
          {t("falsifier.remove")}
        </button>
      )}
    </fieldset>
  );
}
