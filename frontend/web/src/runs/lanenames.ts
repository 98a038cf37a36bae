/** What the lanes of a recorded run are called: by the laws that controlled them. */
import type { Law, RunDetails } from "../api/types";
import { nameLanes } from "../state/lanes";
import { text } from "../text/en";

type Origin = Pick<RunDetails, "configuration" | "commands" | "lanes" | "plant" | "first_tick">;
type Rivals = readonly { law: Law }[];

/** The laws when the recording began; lanes do not change while it goes on. */
export function lawsAtStart(run: Origin): Law[] {
  let law = run.configuration.law as Law;
  let rivals = (run.configuration.rivals ?? []) as Rivals;
  for (const { tick, command } of run.commands) {
    if (tick > run.first_tick) break;
    if (command.kind === "controller") law = command.argument as Law;
    if (command.kind === "rivals") rivals = command.argument as Rivals;
  }
  return [law, ...rivals.map((rival) => rival.law)];
}

/** Lane 1 has another law after every change of the controller. */
function lawsLater(run: Origin): Law[] {
  return run.commands
    .filter(({ tick, command }) => tick > run.first_tick && command.kind === "controller")
    .map(({ command }) => command.argument as Law);
}

export function nameRunLanes(run: Origin): string[] {
  const laws = lawsAtStart(run);
  if (laws.length !== run.lanes.length) return [...run.lanes];
  const [first = "", ...others] = nameLanes(laws, run.plant !== "simulated");
  const later = [...new Set(lawsLater(run))].filter((law) => law !== laws[0]);
  const all = [first, ...later.map((law) => text.controller[law])];
  return [all.join(text.runs.becomes), ...others];
}
