/** When the first load of a recorded run came on. */
import type { RunDetails } from "../api/types";

type Loaded = Pick<RunDetails, "configuration" | "commands" | "period_s" | "first_tick" | "ticks">;

const startOf = (load: unknown): number => {
  const start = (load as { start_s?: unknown } | null)?.start_s;
  return typeof start === "number" ? start : 0;
};

/** Time of the run in s, or null where no load came while it was recorded. */
export function findOnset(run: Loaded): number | null {
  const planned = ((run.configuration.loads ?? []) as unknown[]).map(startOf);
  const given = run.commands
    .filter(({ command }) => command.kind === "load")
    .map(({ tick, command }) => Math.max(tick * run.period_s, startOf(command.argument)));
  const first = run.first_tick * run.period_s;
  const end = (run.first_tick + run.ticks) * run.period_s;
  const onsets = [...planned, ...given].filter((onset) => onset >= first && onset < end);
  return onsets.length === 0 ? null : Math.min(...onsets);
}
