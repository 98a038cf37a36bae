/** The number field of the page: the same for every locale, browser and way of typing. */
import type { ComponentChildren, HTMLAttributes } from "preact";
import { useEffect, useId, useLayoutEffect, useRef, useState } from "preact/hooks";
import { type Demand, readNumber, stepNumber } from "../readnumber";
import { t } from "../text/t";
import { formatInput, roundTo } from "../units";
import { MathSymbol } from "./symbol";

const EXACT_DIGITS = 12;
/** As many as a narrow field shows completely. */
const SHOWN_DIGITS = 6;

/** Without the last decimals, for a field that is not edited. */
const round = (value: number, digits: number): string =>
  formatInput(value, Math.max(digits, String(Math.trunc(Math.abs(value))).length));

const WHEEL_STEP_PX = 50;
const LINE_PX = 33;
const COUNTS: Readonly<Record<string, number>> = {
  ArrowUp: 1,
  ArrowDown: -1,
  PageUp: 10,
  PageDown: -10,
};

export interface NumberInputProps extends Demand {
  id?: string;
  /** The value in force, in the unit on screen; null: none yet. */
  value: number | null;
  /** Significant digits while the field has no focus; an integer part has all of its digits. */
  digits?: number;
  /** Of an arrow key. */
  step?: number | undefined;
  /** Without a `label` element. */
  "aria-label"?: string;
  /** Ids of elements that describe the field, besides the reason of a rejection. */
  describedBy?: string;
  placeholder?: string;
  disabled?: boolean;
  /** The server has rejected its form because of this value. */
  isInvalid?: boolean;
  /** Every valid number while it is typed. */
  onInput?: (value: number) => void;
  /**
   * The number after Enter, leaving the field, an arrow or page key, or the wheel. Resolves to
   * false if it was rejected; the text then stays.
   */
  onCommit?: (value: number) => Promise<boolean>;
  /** The field is empty; without it, a number is required. */
  onEmpty?: () => void;
}

/**
 * While the text is invalid, the reason is below it, its form cannot be submitted, and the value in
 * force remains; Escape restores it.
 */
export function NumberInput(props: NumberInputProps) {
  const { value, digits = SHOWN_DIGITS, step, describedBy, placeholder, disabled } = props;
  const { unit, min, max, isInteger, onInput, onCommit, onEmpty } = props;
  const ownId = useId();
  const input = useRef<HTMLInputElement>(null);
  /** What the user has typed; null: the field shows the value in force. */
  const [typed, setTyped] = useState<string | null>(null);
  const [reason, setReason] = useState("");
  const [isRefused, setRefused] = useState(false);
  /** Text of the last commit, so that leaving the field after Enter is not another. */
  const committed = useRef<string | null>(null);
  const line = useRef<HTMLParagraphElement>(null);
  const turned = useRef(0);
  const pending = useRef(0);
  const [hasFocus, setFocus] = useState(false);
  const held = value === null ? "" : formatInput(value, EXACT_DIGITS);
  const current = typed ?? held;
  const isRounded = typed === null && value !== null && !hasFocus;
  const shown = isRounded ? round(value, digits) : current;
  const label = props.label ?? props["aria-label"] ?? t("numbers.number");
  const demand: Demand = { label, unit: unit ?? "", min, max, isInteger: isInteger ?? false };

  const restore = () => {
    committed.current = null;
    setTyped(null);
    setReason("");
    setRefused(false);
  };
  /** Null if the text is no valid number; an optional field may be empty. */
  const readTyped = (next: string) => {
    if (onEmpty && next.trim() === "") return { value: null };
    return readNumber(next, demand);
  };
  const type = (next: string) => {
    committed.current = null;
    setTyped(next);
    setRefused(false);
    const reading = readTyped(next);
    if ("reason" in reading) return;
    setReason("");
    if (reading.value === null) onEmpty?.();
    else onInput?.(reading.value);
  };
  const commit = async (next: string) => {
    const reading = readTyped(next);
    committed.current = next;
    setTyped(next);
    if ("reason" in reading) {
      setReason(reading.reason);
      return;
    }
    setReason("");
    const isHeld = value !== null && reading.value === roundTo(value, EXACT_DIGITS);
    const isSame = pending.current === 0 && isHeld;
    if (reading.value === null || isSame) return restore();
    pending.current += 1;
    const isTaken = (await onCommit?.(reading.value)) !== false;
    pending.current -= 1;
    if (committed.current !== next) return;
    if (isTaken) restore();
    else setRefused(true);
  };
  const move = (count: number) => {
    const reading = readNumber(current, demand);
    const next = stepNumber("value" in reading ? reading.value : (value ?? 0), count, demand, step);
    type(formatInput(next, EXACT_DIGITS));
    void commit(formatInput(next, EXACT_DIGITS));
  };
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.isComposing || event.ctrlKey || event.altKey || event.metaKey) return;
    const count = COUNTS[event.key];
    if (count !== undefined) {
      event.preventDefault();
      move(count * (event.shiftKey && Math.abs(count) === 1 ? 10 : 1));
    } else if (event.key === "Enter" && typed !== null) void commit(current);
    else if (event.key === "Escape" && !event.shiftKey && typed !== null) {
      event.preventDefault();
      restore();
      if (value === null) onEmpty?.();
    }
  };
  const onWheel = (event: WheelEvent) => {
    if (document.activeElement !== input.current) return;
    event.preventDefault();
    turned.current -= event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE_PX : 1);
    if (Math.abs(turned.current) < WHEEL_STEP_PX) return;
    move(Math.sign(turned.current));
    turned.current = 0;
  };
  const onInvalid = (event: Event) => {
    event.preventDefault();
    void commit(current);
    if (input.current?.form?.querySelector(":invalid") === input.current) input.current?.focus();
  };

  // A newer value in force replaces a text that is no longer edited.
  useEffect(() => {
    if (document.activeElement !== input.current) restore();
  }, [value]);
  useEffect(() => {
    if (reason !== "") line.current?.scrollIntoView({ block: "nearest" });
  }, [reason]);
  useLayoutEffect(() => {
    const reading = typed === null && value !== null ? null : readTyped(current);
    input.current?.setCustomValidity(reading && "reason" in reading ? reading.reason : "");
  });

  return (
    <>
      <span class="line tight number-input">
        {(min === undefined || min < 0) && (
          <button
            type="button"
            class="button sign"
            tabIndex={-1}
            aria-label={t("numbers.sign")}
            disabled={disabled}
            onPointerDown={(event) => {
              event.preventDefault();
              input.current?.focus();
              type(/^[-\u2212]/.test(current) ? current.slice(1) : `-${current}`);
            }}
          >
            ±
          </button>
        )}
        <input
          ref={input}
          id={props.id ?? ownId}
          type="text"
          inputMode="decimal"
          role="spinbutton"
          autocomplete="off"
          spellcheck={false}
          placeholder={placeholder}
          disabled={disabled}
          required={!onEmpty}
          value={shown}
          aria-label={props["aria-label"]}
          aria-valuenow={value ?? undefined}
          aria-valuetext={`${shown} ${demand.unit}`.trim()}
          aria-valuemin={min}
          aria-valuemax={max}
          aria-invalid={reason !== "" || isRefused || props.isInvalid === true}
          aria-describedby={[describedBy, `${ownId}-reason`].filter(Boolean).join(" ")}
          onInput={(event) => type(event.currentTarget.value)}
          onFocus={({ currentTarget: field }) => {
            const isSelected = field.selectionEnd !== 0 && field.selectionStart === 0;
            // Before the browser selects the text or places the caret in it.
            field.value = current;
            if (isSelected) field.select();
            setFocus(true);
          }}
          onBlur={() => {
            setFocus(false);
            if (typed !== null && typed !== committed.current) void commit(typed);
          }}
          onKeyDown={onKeyDown}
          onWheel={onWheel}
          onInvalid={onInvalid}
        />
      </span>
      <p class="problem" id={`${ownId}-reason`} role="alert" hidden={reason === ""} ref={line}>
        {reason}
      </p>
    </>
  );
}

interface NumberFieldProps extends Omit<NumberInputProps, "id" | "aria-label"> {
  label: string;
  /** Extends the label for screen readers if the label is clear only within its group. */
  labelRest?: string | undefined;
  /** Explanation, shown when the pointer rests on the field. */
  title?: string | undefined;
  /** Between label and number, such as a slider; and below them. */
  slider?: ComponentChildren;
  below?: ComponentChildren;
  /** Attributes of the element around label and number. */
  container?: HTMLAttributes<HTMLDivElement>;
}

/** A number with its label and unit; in a `form` the label is above it. */
export function NumberField(props: NumberFieldProps) {
  const { label, labelRest, title, slider, below, container, describedBy, ...input } = props;
  const id = useId();
  return (
    <div class={`field ${slider ? "" : "is-plain"}`} title={title} {...container}>
      <label for={id}>
        <MathSymbol text={label} />
        {labelRest && <span class="visually-hidden"> {labelRest}</span>}
      </label>
      {slider}
      <NumberInput
        {...input}
        label={label}
        id={id}
        describedBy={[`${id}-unit`, describedBy].filter(Boolean).join(" ")}
      />
      <span class="unit" id={`${id}-unit`}>
        {input.unit}
      </span>
      {below}
    </div>
  );
}
