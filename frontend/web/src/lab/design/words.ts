/** Poles and numbers of a design as text. */
import type { DesignResponse, Margins, Prediction, Stability } from "../../core/api/design";
import { t } from "../../core/text/t";
import { formatFixed, formatInput, formatNumber, toDegrees } from "../../core/units";
import { countPlaces, type Pole, type Poles } from "./poles";

const MINUS = "\u2212";

const plain = (value: number) => formatInput(Math.abs(value), 4);
const signed = (value: number) => (value < 0 ? MINUS : "") + plain(value);

export function describePole({ re, im }: Pole): string {
  return im === 0
    ? signed(re)
    : t("design.complex", { re: signed(re), sign: im > 0 ? "+" : "−", im: plain(im) });
}

/** "−60 ×4" or "−40 ± 30j, −60 ×2". */
export function describePoles(poles: Poles): string {
  return countPlaces(poles.filter(({ im }) => im >= 0))
    .map(({ pole, count }) => {
      const place = pole.im === 0 ? signed(pole.re) : `${signed(pole.re)} ± ${plain(pole.im)}j`;
      return count > 1 ? `${place} ${t("design.many", { count })}` : place;
    })
    .join(", ");
}

export const degreesOf = (rad: number) => `${formatNumber(Math.abs(toDegrees(rad)), 3, 3)}°`;
export const torqueOf = (torque: number) => `${formatNumber(torque, 3, 4)} N·m`;

/** Never marked as good if a limit is exceeded, however shortly. */
export const verdictOf = ({ verdict, reasons }: Prediction): Prediction["verdict"] | "note" =>
  verdict === "ok" && reasons.length > 0 ? "note" : verdict;

interface Caveat {
  /** Short text in the chart. */
  short: string;
  /** Text below it. */
  summary: string;
}

/** Why the curves of a design are not a valid prediction, or null if they are. */
export function caveatOf(
  response: Pick<DesignResponse, "largest_pole" | "encoders">,
): Caveat | null {
  if (response.largest_pole < 1) return null;
  const { encoders } = response;
  return {
    short: t(`stability.unstableOn.${encoders}.short`),
    summary: t(`stability.unstableOn.${encoders}.summary`, {
      pole: formatFixed(response.largest_pole, 4),
    }),
  };
}

const ratio = (value: number) => formatNumber(value, 3, 2);

/** Ratios of the true to the nominal value of a parameter for which the loop is stable. */
export function rangeOf({ low, high }: Pick<Stability["ranges"][number], "low" | "high">): string {
  if (high === null)
    return low === null ? t("stability.all") : t("stability.from", { low: ratio(low) });
  return low === null
    ? t("stability.upTo", { high: ratio(high) })
    : t("stability.between", { low: ratio(low), high: ratio(high) });
}

/** Factors on a torque for which the loop stays stable. */
export function gainRangeOf(range: Margins["torque1_gain"]): string {
  if (range === null) return t("stability.all");
  return rangeOf({ low: range.low ?? 0, high: range.high });
}

/** "M −24 %, B1 +18 %", without those that round to zero. */
export function errorsOf(errors: Record<string, number>): string {
  return Object.entries(errors)
    .filter(([, error]) => Math.abs(error) >= 0.005)
    .map(([symbol, error]) => {
      const sign = error < 0 ? MINUS : "+";
      return `${symbol} ${sign}${Math.round(100 * Math.abs(error))} %`;
    })
    .join(", ");
}
