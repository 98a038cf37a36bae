import type { Candidate } from "../../core/api/jobs";
import { text } from "../../core/text/en";
import { formatNumber } from "../../core/units";
import { Curves } from "../design/curves";
import { bestSoFar } from "./tuning";

const words = text.tuning;

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
        title={words.curve}
        summary={words.curveSummary(
          formatNumber(first.cost),
          formatNumber(last),
          candidates.length - 1,
        )}
        x={{ limits: [0, budget], label: words.candidates }}
        y={{ limits, label: words.costAxis }}
        curves={[
          { look: "each", points: candidates.map(({ number, cost }) => [number, cost] as const) },
          { look: "tried", points: best },
        ]}
      />
      <p class="row small responses-legend">
        <span>{words.best}</span>
        <span class="is-each">{words.each}</span>
      </p>
    </div>
  );
}
