/** Which part of a run its picture shows first. */
import type { Scenario } from "../../core/api/falsifications";
import type { Span } from "../../core/plots/spans";

const BEFORE_S = 1;

/** From a little before the first load on, to the end. */
export function spanOf(scenario: Scenario, time: readonly number[]): Span {
  const loads = (scenario.loads ?? []) as { start_s?: number }[];
  const onsets = loads.flatMap(({ start_s: start }) => start ?? []);
  const first = onsets.length > 0 ? Math.min(...onsets) - BEFORE_S : 0;
  return { from: Math.max(time[0] ?? 0, first), to: time.at(-1) ?? 1 };
}
