/** What lanes are called: by the laws that control them. */
import type { Law, RunDetails } from "./api/types";
import { text } from "./text/en";

export type LaneOrigin = Pick<
  RunDetails,
  "configuration" | "commands" | "lanes" | "plant" | "first_tick"
>;
type Rivals = readonly { law: Law }[];

/** The laws by name; where two lanes have one law, with the number of the lane. A bench's
 * first two lanes are the bench itself and its simulated twin. */
export function nameLanes(laws: readonly Law[], isBench = false): string[] {
  return laws.map((law, index) => {
    if (isBench && index < text.compare.bench.length) {
      return `${text.compare.bench[index]} ${text.controller[law]}`;
    }
    const isAlone = laws.filter((one) => one === law).length === 1;
    return isAlone ? text.controller[law] : text.compare.numbered(text.controller[law], index + 1);
  });
}

/** The laws when the recording began; lanes do not change while it goes on. */
function lawsAtStart(run: LaneOrigin): Law[] {
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
function lawsLater(run: LaneOrigin): Law[] {
  return run.commands
    .filter(({ tick, command }) => tick > run.first_tick && command.kind === "controller")
    .map(({ command }) => command.argument as Law);
}

/** The lanes of a recorded run. */
export function nameRunLanes(run: LaneOrigin): string[] {
  const laws = lawsAtStart(run);
  if (laws.length !== run.lanes.length) return [...run.lanes];
  const [first = "", ...others] = nameLanes(laws, run.plant !== "simulated");
  const later = [...new Set(lawsLater(run))].filter((law) => law !== laws[0]);
  const all = [first, ...later.map((law) => text.controller[law])];
  return [all.join(text.runs.becomes), ...others];
}
