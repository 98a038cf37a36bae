/** The reason of a rejection, in the names and units of the page. */
import type { RefusedError, Violation } from "../api/errors";
import { type Quantity, quantityOf } from "../quantities";
import { text } from "../text/en";
import { formatInput } from "../units";
import { effectQuantityOf } from "./kinds";
import { parameterOf } from "./laws";

const words = text.refusal;
const MAX_SHOWN = 3;

export function explainRefusal({ message, violations }: RefusedError): string {
  if (violations.length === 0) return message;
  return violations.slice(0, MAX_SHOWN).map(explainViolation).join(" ");
}

export function explainViolation(violation: Violation): string {
  const quantity =
    quantityOf(violation.name) ?? effectQuantityOf(violation.name) ?? parameterOf(violation.name);
  if (quantity === null) return violation.message;
  const { label } = quantity;
  if (violation.finding) return words.finding(label, violation.finding);
  if (violation.value === null) return words.missing(label);
  const limits = describeLimits(violation.limits, quantity);
  if (typeof violation.value === "number" && limits !== null) {
    return words.outOfRange(label, formatQuantity(violation.value, quantity), limits);
  }
  return limits === null && quantity.factor === undefined
    ? words.wrong(label, violation.bound)
    : violation.message;
}

export function formatQuantity(value: number, { unit, factor = 1 }: Quantity): string {
  const number = formatInput(value * factor).replace("-", "\u2212");
  return unit === "" ? number : `${number} ${unit}`;
}

function describeLimits(limits: Violation["limits"], quantity: Quantity): string | null {
  const { ge, gt, le, lt } = limits ?? {};
  if (ge !== undefined && le !== undefined) {
    return words.between(
      formatQuantity(ge, { ...quantity, unit: "" }),
      formatQuantity(le, quantity),
    );
  }
  if (ge !== undefined) return words.atLeast(formatQuantity(ge, quantity));
  if (gt !== undefined) return words.moreThan(formatQuantity(gt, quantity));
  if (le !== undefined) return words.atMost(formatQuantity(le, quantity));
  return lt === undefined ? null : words.lessThan(formatQuantity(lt, quantity));
}
