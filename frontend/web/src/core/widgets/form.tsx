/** Parts of a form: choices, numbers, and the reason of a rejection. */
import { useEffect, useId, useRef, useState } from "preact/hooks";
import { RefusedError } from "../api/errors";
import type { Quantity } from "../schema";
import { problem } from "../state/actions";
import { explainRefusal } from "../state/refusal";
import { t } from "../text/t";

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
  /**
   * Resolves when the server has accepted or rejected the choice; until then it is shown as
   * selected.
   */
  onChoose: (value: T) => unknown;
}

/** Select one of a few options, all visible. */
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

interface ProblemProps {
  control: string;
  id?: string;
  /** The end of the field's path in the request, and how it writes its value. */
  path?: string | undefined;
  quantity?: Quantity;
}

/** Reason why the server rejected a control's request; scrolled into view in its panel. */
export function Problem({ control, id, path, quantity }: ProblemProps) {
  const line = useRef<HTMLParagraphElement>(null);
  const mine = problem.value?.control === control ? problem.value : null;
  const again = mine?.retry;
  useEffect(() => {
    if (mine !== null) line.current?.scrollIntoView({ block: "nearest" });
  }, [mine]);
  return (
    <p class="problem" id={id} role="alert" hidden={mine === null} ref={line}>
      {mine?.error instanceof RefusedError
        ? explainRefusal(mine.error, path, quantity)
        : mine?.message}
      {again && (
        <>
          {" "}
          <button type="button" class="button is-small" onClick={() => void again()}>
            {t("meanwhile.again")}
          </button>
        </>
      )}
    </p>
  );
}

/** Reason why a request of the page or of its form was rejected; hidden while it is empty. */
export function ErrorLine({ children, id }: { children: string; id?: string }) {
  return (
    <p class="problem" id={id} role="alert" hidden={children === ""}>
      {children}
    </p>
  );
}

interface SelectFieldProps<T extends string> {
  label: string;
  value: T;
  options: readonly T[];
  /** Text of an option. */
  name: (value: T) => string;
  title?: string;
  disabled?: boolean;
  onChoose: (value: T) => void;
}

/** Select one option, below its label. */
export function SelectField<T extends string>(props: SelectFieldProps<T>) {
  const { label, value, options, name, title, disabled, onChoose } = props;
  return (
    <label title={title}>
      <span>{label}</span>
      <select
        value={value}
        disabled={disabled}
        onChange={(event) => onChoose(event.currentTarget.value as T)}
      >
        {options.map((option) => (
          <option key={option} value={option}>
            {name(option)}
          </option>
        ))}
      </select>
    </label>
  );
}
