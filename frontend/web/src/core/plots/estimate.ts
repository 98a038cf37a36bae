/** The stiffness estimate: whether it is known, and how it is written. */
import { derive, type ReadChannel } from "../stream/derived";
import { t } from "../text/t";
import { formatInterval, formatNumber } from "../units";

export const ESTIMATE = "stiffness_estimate_nm_per_rad";
/** With a wider interval, relative to the estimate, the stiffness is not known. */
const LARGEST_SHARE = 0.2;

type Estimate =
  | { state: "off" | "misfit" | "unknown" }
  | { state: "known"; value: number; half: number };

/** "off" also without a sample; "misfit": the spring has another shape than the nominal one. */
function judgeEstimate(read: ReadChannel): Estimate {
  const value = read(ESTIMATE);
  if (Number.isNaN(value)) return { state: Number.isNaN(read("spring_misfit")) ? "off" : "misfit" };
  const half = Math.abs(derive("stiffness_upper_nm_per_rad", read) - value);
  const isKnown = half <= LARGEST_SHARE * Math.abs(value);
  return isKnown ? { state: "known", value, half } : { state: "unknown" };
}

/** For the legend: the number with its interval, or why there is none; empty while it is off. */
export function describeEstimate(read: ReadChannel): string {
  const estimate = judgeEstimate(read);
  if (estimate.state === "known") return formatInterval(estimate.value, estimate.half);
  return estimate.state === "off" ? "" : t(`spring.${estimate.state}`);
}

/** The same as a sentence with the relative interval. */
export function describeKnowledge(read: ReadChannel): string {
  const estimate = judgeEstimate(read);
  if (estimate.state === "off") return "";
  if (estimate.state !== "known") return t(`spring.sentences.${estimate.state}`);
  const percent = formatNumber((100 * estimate.half) / Math.abs(estimate.value), 2, 1);
  return t("spring.sentences.known", { percent });
}
