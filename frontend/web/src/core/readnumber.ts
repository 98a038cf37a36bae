/**
 * Numbers as users type them. The decimal sign is a point or a comma, whatever the language of the
 * browser is. What could mean two numbers is rejected, never guessed.
 */
import { hasDecimalComma, localize } from "./text/language";
import { t } from "./text/t";
import { formatInput } from "./units";

const MINUS = /^[\u2010-\u2013\u2212\ufe63\uff0d]/;
/** Arabic-Indic, Persian and full-width digits: the last four bits are the value. */
const OTHER_DIGITS = /[\u0660-\u0669\u06f0-\u06f9\uff10-\uff19]/g;
const OTHER_SIGNS: Readonly<Record<string, string>> = {
  "\u066b": ".",
  "\uff0e": ".",
  "\uff0c": ",",
  "\uff0b": "+",
};
/** Spaces and invisible direction marks around a pasted number. */
const AROUND = /^[\s\u200b-\u200f\u061c\u2066-\u2069]+|[\s\u200b-\u200f\u061c\u2066-\u2069]+$/g;
const NUMBER = /^[+-]?(\d+[.,]?\d*|[.,]\d+)(e[+-]?\d{1,4})?$/i;
const GROUPED = /^[+-]?\d[\d.,'’_\u066c\s]*$/;
/** Only the sign that the page itself does not write can be a thousands separator here. */
const AMBIGUOUS = hasDecimalComma ? /^[+-]?[1-9]\d{0,2}\.\d{3}$/ : /^[+-]?[1-9]\d{0,2},\d{3}$/;

/** What a field accepts, in the unit on screen. */
export interface Demand {
  /** Name of the field. */
  label?: string;
  unit?: string;
  min?: number | undefined;
  max?: number | undefined;
  isInteger?: boolean;
}

export type Reading = { value: number } | { reason: string };

const write = (value: number): string => formatInput(value, 12).replace("-", "\u2212");

const withUnit = (value: number, { unit = "" }: Demand): string =>
  unit === "" ? write(value) : `${write(value)} ${unit}`;

function describeBounds(demand: Demand): string {
  const { unit = "", min, max } = demand;
  if (min !== undefined && max !== undefined) {
    return t("refusal.between", { least: write(min), most: withUnit(max, demand) });
  }
  if (min !== undefined) return t("refusal.atLeast", { bound: withUnit(min, demand) });
  if (max !== undefined) return t("refusal.atMost", { bound: withUnit(max, demand) });
  return unit && t("numbers.inUnit", { unit });
}

/** A typed number without bounds, or the reason why it is none. */
export function parseNumber(typed: string): Reading {
  const trimmed = typed.replace(AROUND, "");
  const plain = trimmed
    .replace(MINUS, "-")
    .replace(OTHER_DIGITS, (digit) => String(digit.charCodeAt(0) & 15))
    .replace(/[\u066b\uff0e\uff0c\uff0b]/g, (sign) => OTHER_SIGNS[sign] as string);
  if (plain === "") return { reason: t("numbers.missing") };
  if (AMBIGUOUS.test(plain)) {
    return {
      reason: t("numbers.ambiguous", {
        typed: trimmed,
        whole: plain.replace(/[.,]/, ""),
        decimal: localize(plain.replace(",", ".")),
      }),
    };
  }
  if (!NUMBER.test(plain)) {
    return {
      reason: t(GROUPED.test(plain) ? "numbers.grouped" : "numbers.noNumber", { typed: trimmed }),
    };
  }
  const value = Number(plain.replace(",", "."));
  if (!Number.isFinite(value)) return { reason: t("numbers.tooLarge", { typed: trimmed }) };
  if (value === 0 && /[1-9]/.test(plain.replace(/e.*/i, ""))) {
    return { reason: t("numbers.tooSmall", { typed: trimmed }) };
  }
  return { value };
}

/** A typed number that a field accepts, or the reason with unit and bounds. */
export function readNumber(typed: string, demand: Demand): Reading {
  const reading = parseNumber(typed);
  const { label = t("numbers.number"), min = -Infinity, max = Infinity, isInteger } = demand;
  const bounds = describeBounds(demand);
  const reject = (reason: string): Reading => ({
    reason: t(isInteger ? "numbers.rejectedInteger" : "numbers.rejected", {
      name: label,
      reason,
      bounds: bounds && ` ${bounds}`,
    }),
  });
  if ("reason" in reading) return reject(reading.reason);
  const { value } = reading;
  if (value < min || value > max) {
    return {
      reason: t("refusal.outOfRange", {
        name: label,
        value: withUnit(value, demand),
        bound: bounds,
      }),
    };
  }
  if (!isInteger || Number.isSafeInteger(value)) return reading;
  return reject(t("numbers.noInteger", { value: write(value) }));
}

/**
 * The next value of an arrow key: by `step`, or by one of the second digit of the value.
 *
 * count: number of steps, negative for less.
 */
export function stepNumber(value: number, count: number, demand: Demand, step?: number): number {
  const { min = -Infinity, max = Infinity, isInteger = false } = demand;
  const size = Math.abs(value) || (Number.isFinite(max) ? max / 10 : 10);
  const own = 10 ** (Math.floor(Math.log10(size)) - 1);
  const next = value + count * (step ?? (isInteger ? 1 : own));
  return Math.min(max, Math.max(min, Number(next.toPrecision(12))));
}
