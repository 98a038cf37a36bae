/** Whether numbers of runs may be held against each other: only of what was asked of all alike. */
import type { RunDifference } from "../../core/api/types";
import { CHANGES, CHANGES_OF_CONTROLLER, CONTROLLER, LOADS } from "../../core/text/changes";
import { text } from "../../core/text/en";
import type { Overlaid } from "./overlaid";

const words = text.overlay.unlike;

/**
 * What is compared may differ: who controls, with what, and what the server calls a change of it;
 * when a load came is compared in session time, where the server tells it from the record's start.
 */
function listDiffering({ differences }: RunDifference): string[] {
  const found = differences.filter(
    ({ group, name }) =>
      group !== CONTROLLER &&
      group !== LOADS &&
      !(group === CHANGES && CHANGES_OF_CONTROLLER.includes(name)),
  );
  return [...new Set(found.map(({ group, name }) => (group === CHANGES ? name : group)))];
}

const areSame = (keys: readonly unknown[]): boolean => new Set(keys).size <= 1;

/**
 * Why none of these numbers may be called the best; "" where one may.
 *
 * difference: of the settings of the runs; null where it is not known.
 */
export function whyUnlike(curves: readonly Overlaid[], difference: RunDifference | null): string {
  const begins = curves.map(({ window }) => window && `${window.kind} ${window.label}`);
  if (begins.includes(null) || !areSame(begins)) return words.windows;
  if (!areSame(curves.map(({ plant }) => plant))) return words.plants;
  if (areSame(curves.map(({ run }) => run))) return "";
  if (difference === null) return words.unknown;
  const differing = listDiffering(difference);
  if (differing.length > 0) return words.settings(differing);
  return areSame(curves.map(({ loads }) => loads)) ? "" : words.loads;
}

/** Whether the windows are of one length, to a tick: else their rms is not of the same. */
export function areOfOneLength(curves: readonly Overlaid[]): boolean {
  const lengths = curves.map(({ window }) => window && window.end_tick - window.first_tick);
  return !lengths.includes(null) && areSame(lengths);
}
