import type { Trial } from "../../core/api/jobs";
import { text } from "../../core/text/en";
import { formatNumber } from "../../core/units";
import { Curves } from "../design/curves";
import { bestSoFar } from "./tuning";

const words = text.tuning;

/** How the best cost falls, over what each candidate cost. */
export function CostCurve({ trials, budget }: { trials: readonly Trial[]; budget: number }) {
  const first = trials[0];
  if (first === undefined) return null;
  const best = bestSoFar(trials);
  const last = best.at(-1)?.[1] ?? first.cost;
  const top = 1.25 * Math.max(first.cost, 1.6 * last);
  return (
    <div>
      <Curves
        title={words.curve}
        summary={words.curveSummary(
          formatNumber(first.cost),
          formatNumber(last),
          trials.length - 1,
        )}
        x={{ limits: [0, budget], label: words.candidates }}
        y={{ limits: [0, top], label: words.costAxis }}
        curves={[
          { look: "each", points: trials.map(({ number, cost }) => [number, cost] as const) },
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
