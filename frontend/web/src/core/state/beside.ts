/** What *Compare* switches on: the controllers that stood beside last, or the first other law. */
import { effect, signal } from "@preact/signals";
import type { Lane, SessionState } from "../api/types";
import { comparisonsOf, hasOwnSettings } from "./lanes";
import { otherLaw } from "./laws";
import { session } from "./session";

const last = signal<readonly Lane[]>([]);

/** Without what would be the session's own controller a second time. */
export function comparedWith(state: SessionState): readonly Lane[] {
  const { law } = state.configuration;
  const kept = last.value.filter((lane) => lane.law !== law || hasOwnSettings(lane));
  const other = otherLaw(law);
  if (kept.length > 0 || other === undefined) return kept;
  return [{ law: other }];
}

export const watchBeside = (): (() => void) =>
  effect(() => {
    const { value: state } = session;
    if (state !== null && comparisonsOf(state).length > 0) last.value = comparisonsOf(state);
  });
