import type { Trial } from "../../core/api/jobs";
import { text } from "../../core/text/en";
import { formatNumber } from "../../core/units";
import { type Axis, Curves } from "../design/curves";
import { bestSoFar } from "./tuning";

const words = text.tuning;
const STEPS = [1, 2, 5];
const MAX_TICKS = 5;

/** Even steps of 1, 2 or 5 times a power of ten, at most five of them. */
export function ticksUpTo(most: number, least: number): number[] {
  const size = 10 ** Math.floor(Math.log10(most / MAX_TICKS));
  const step =
    [...STEPS, 10].map((one) => one * size).find((one) => most / one <= MAX_TICKS) ?? most;
  const count = Math.floor(most / Math.max(step, least) + 1e-9);
  return Array.from({ length: count + 1 }, (_, index) => index * Math.max(step, least));
}

/** How the best cost falls, over what each candidate cost. */
export function CostCurve({ trials, budget }: { trials: readonly Trial[]; budget: number }) {
  const first = trials[0];
  if (first === undefined) return null;
  const best = bestSoFar(trials);
  const last = best.at(-1)?.[1] ?? first.cost;
  const top = 1.25 * Math.max(first.cost, 1.6 * last);
  const x: Axis = {
    from: 0,
    to: budget,
    ticks: ticksUpTo(budget, 1),
    label: words.candidates,
  };
  const y: Axis = { from: 0, to: top, ticks: ticksUpTo(top, 0), label: words.costAxis };
  return (
    <div>
      <Curves
        title={words.curve}
        summary={words.curveSummary(
          formatNumber(first.cost),
          formatNumber(last),
          trials.length - 1,
        )}
        x={x}
        y={y}
        curves={[
          { look: "present", points: trials.map(({ number, cost }) => [number, cost] as const) },
          { look: "tried", points: best },
        ]}
      />
      <p class="responses-legend">
        <span>{words.best}</span>
        <span class="is-present">{words.each}</span>
      </p>
    </div>
  );
}
