import { useId } from "preact/hooks";

interface NumberBoxProps {
  label: string;
  unit: string;
  value: string;
  onInput: (value: string) => void;
}

/** A number of a form, as it is typed. */
export function NumberBox({ label, unit, value, onInput }: NumberBoxProps) {
  const id = useId();
  return (
    <div class="field is-plain">
      <label for={id}>{label}</label>
      <input
        id={id}
        type="number"
        step="any"
        required
        value={value}
        onInput={(event) => onInput(event.currentTarget.value)}
      />
      <span class="unit">{unit}</span>
    </div>
  );
}
