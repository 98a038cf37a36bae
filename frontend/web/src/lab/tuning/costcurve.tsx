import type { Candidate } from "../../core/api/jobs";
import { Swatch } from "../../core/plots/legend";
import { t } from "../../core/text/t";
import { formatNumber } from "../../core/units";
import { Curves, LOOKS } from "../design/curves";
import { bestSoFar } from "./tuning";

/** The best cost over the candidates, with the cost of each. */
export function CostCurve({
  candidates,
  budget,
}: {
  candidates: readonly Candidate[];
  budget: number;
}) {
  const first = candidates[0];
  if (first === undefined) return null;
  const best = bestSoFar(candidates);
  const last = best.at(-1)?.[1] ?? first.cost;
  const limits = [last - 0.3, Math.max(first.cost, last + 1.2) + 0.3] as const;
  return (
    <div>
      <Curves
        title={t("tuning.curve")}
        summary={t("tuning.curveSummary", {
          tried: candidates.length - 1,
          first: formatNumber(first.cost),
          best: formatNumber(last),
        })}
        x={{ limits: [0, budget], label: t("tuning.candidates") }}
        y={{ limits, label: t("tuning.costAxis") }}
        curves={[
          { look: "each", points: candidates.map(({ number, cost }) => [number, cost] as const) },
          { look: "tried", points: best },
        ]}
      />
      <p class="row small">
        <span>
          <Swatch look={LOOKS.tried} /> {t("tuning.best")}
        </span>
        <span>
          <Swatch look={LOOKS.each} /> {t("tuning.each")}
        </span>
      </p>
    </div>
  );
}
