/** The reason of a rejection, in the names and units of the page. */
import type { RefusedError, Violation } from "../api/errors";
import { quantityOf } from "../quantities";
import type { Quantity } from "../schema";
import { t } from "../text/t";
import { formatInput } from "../units";
import { effectQuantityOf } from "./kinds";

const MAX_SHOWN = 3;

/** path: of the field that was edited, in the request; it names and writes its own value. */
export function explainRefusal(refusal: RefusedError, path?: string, own?: Quantity): string {
  const { message, violations } = refusal;
  if (violations.length === 0) return message;
  const isOwn = ({ name }: Violation) => path && `.${name}`.endsWith(`.${path}`);
  return violations
    .slice(0, MAX_SHOWN)
    .map((violation) => explainViolation(violation, isOwn(violation) ? own : undefined))
    .join(" ");
}

const findQuantity = ({ name }: Violation): Quantity | null =>
  quantityOf(name) ?? effectQuantityOf(name);

export function explainViolation(
  violation: Violation,
  quantity: Quantity | null = findQuantity(violation),
): string {
  if (quantity === null) return violation.message;
  const { label } = quantity;
  if (violation.finding) return t("refusal.finding", { name: label, finding: violation.finding });
  if (violation.value === null) return t("refusal.missing", { name: label });
  const limits = describeLimits(violation.limits, quantity);
  if (typeof violation.value === "number" && limits !== null) {
    return t("refusal.outOfRange", {
      name: label,
      value: formatQuantity(violation.value, quantity),
      bound: limits,
    });
  }
  return limits === null && quantity.factor === undefined
    ? t("refusal.wrong", { name: label, bound: violation.bound })
    : violation.message;
}

export function formatQuantity(value: number, { unit, factor = 1 }: Quantity): string {
  const number = formatInput(value * factor).replace("-", "\u2212");
  return unit === "" ? number : `${number} ${unit}`;
}

function describeLimits(limits: Violation["limits"], quantity: Quantity): string | null {
  const { ge, gt, le, lt } = limits ?? {};
  if (ge !== undefined && le !== undefined) {
    return t("refusal.between", {
      least: formatQuantity(ge, { ...quantity, unit: "" }),
      most: formatQuantity(le, quantity),
    });
  }
  if (ge !== undefined) return t("refusal.atLeast", { bound: formatQuantity(ge, quantity) });
  if (gt !== undefined) return t("refusal.moreThan", { bound: formatQuantity(gt, quantity) });
  if (le !== undefined) return t("refusal.atMost", { bound: formatQuantity(le, quantity) });
  return lt === undefined ? null : t("refusal.lessThan", { bound: formatQuantity(lt, quantity) });
}
