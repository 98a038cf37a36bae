import { text } from "../../core/text/en";
import { BODIES, changeKind, KINDS, type Kind, type TermForm } from "./definition";

const words = text.falsifier;

interface RangeProps {
  label: string;
  ends: readonly [number, number];
  onChange: (ends: readonly [number, number]) => void;
}

function Range({ label, ends, onChange }: RangeProps) {
  const field = (at: 0 | 1, name: string) => (
    <label>
      <span>{name}</span>
      <input
        type="number"
        step="any"
        min={0}
        required
        value={ends[at]}
        onInput={(event) => {
          const value = event.currentTarget.valueAsNumber;
          onChange(at === 0 ? [value, ends[1]] : [ends[0], value]);
        }}
      />
    </label>
  );
  return (
    <div class="desk-fields">
      {field(0, label)}
      {field(1, words.to)}
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

/** One load of the family: its kind, on what, how large, when, and how long or how fast. */
export function TermFields({ number, term, canBeRemoved, onChange, onRemove }: TermFieldsProps) {
  return (
    <fieldset class="falsifier-term">
      <legend>{words.load(number)}</legend>
      <div class="desk-fields">
        <label>
          <span>{words.kind}</span>
          <select
            value={term.kind}
            onChange={(event) => onChange(changeKind(term, event.currentTarget.value as Kind))}
          >
            {KINDS.map((kind) => (
              <option key={kind} value={kind}>
                {words.kinds[kind]}
              </option>
            ))}
          </select>
        </label>
        <label>
          <span>{words.torque}</span>
          <input
            type="number"
            step="any"
            min={0}
            max={50}
            required
            value={term.torqueNm}
            onInput={(event) => onChange({ ...term, torqueNm: event.currentTarget.valueAsNumber })}
          />
        </label>
      </div>
      <p class="falsifier-bodies">
        <span class="hint">{words.onBodies}</span>
        {BODIES.map((body) => {
          const others = term.bodies.filter((one) => one !== body);
          const isOn = others.length < term.bodies.length;
          return (
            <label key={body}>
              <input
                type="checkbox"
                checked={isOn}
                disabled={isOn && others.length === 0}
                onChange={() => onChange({ ...term, bodies: isOn ? others : [...others, body] })}
              />{" "}
              {words.bodies[body]}
            </label>
          );
        })}
      </p>
      <Range
        label={words.onsetFrom}
        ends={term.startS}
        onChange={(startS) => onChange({ ...term, startS })}
      />
      {term.kind !== "step" && (
        <Range
          label={words.ownFrom[term.kind]}
          ends={term.own}
          onChange={(own) => onChange({ ...term, own })}
        />
      )}
      {canBeRemoved && (
        <button
          type="button"
          class="button"
          aria-label={words.removeLabel(number)}
          onClick={onRemove}
        >
          {words.remove}
        </button>
      )}
    </fieldset>
  );
}
