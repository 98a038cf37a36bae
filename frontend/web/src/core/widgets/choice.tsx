import { useId, useState } from "preact/hooks";

export interface Option<T extends string> {
  value: T;
  label: string;
}

interface ChoiceProps<T extends string> {
  label: string;
  options: readonly Option<T>[];
  /** null: none of them. */
  value: T | null;
  describedBy?: string;
  /** Resolves when the choice was taken or refused; until then it stands as chosen. */
  onChoose: (value: T) => unknown;
}

/** One of a few, all in sight. */
export function Choice<T extends string>(props: ChoiceProps<T>) {
  const group = useId();
  const [pending, setPending] = useState<T | null>(null);
  const choose = async (value: T) => {
    setPending(value);
    await props.onChoose(value);
    setPending(null);
  };
  return (
    <div class="choice" role="radiogroup" aria-label={props.label}>
      {props.options.map((option) => (
        <label key={option.value}>
          <input
            type="radio"
            name={group}
            checked={(pending ?? props.value) === option.value}
            aria-describedby={props.describedBy}
            onChange={() => void choose(option.value)}
          />
          <span>{option.label}</span>
        </label>
      ))}
    </div>
  );
}
