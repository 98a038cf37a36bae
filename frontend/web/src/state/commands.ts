/** What a button does and a key does too. */
import {
  addLoad,
  pause,
  putLanes,
  readState,
  removeLoad,
  start,
  startRecording,
  stopRecording,
} from "../api/client";
import type { Law, SessionState } from "../api/types";
import { perform } from "./actions";
import { rivalsOf } from "./lanes";
import { otherLaw } from "./laws";
import { hungWeights, nextWeight } from "./load";

/** Names of the controls that show why a command was refused. */
export const CONTROL = {
  session: "session",
  load: "load.weight",
  compare: "controller.compare",
} as const;

export function toggleRun(state: SessionState): Promise<boolean> {
  return perform(CONTROL.session, state.status === "running" ? pause : start);
}

export function toggleRecording({ recording }: SessionState): Promise<boolean> {
  return perform(CONTROL.session, recording === null ? startRecording : stopRecording);
}

export function toggleCompare(state: SessionState): Promise<boolean> {
  const other = otherLaw(state.configuration.law);
  return compareWith(rivalsOf(state).length > 0 || other === undefined ? null : other);
}

/** Run this law beside the session's own, or none. */
export function compareWith(law: Law | null): Promise<boolean> {
  return perform(CONTROL.compare, () => putLanes(law === null ? [] : [law]));
}

async function removeWeights(state: SessionState): Promise<SessionState> {
  for (const row of hungWeights(state)) await removeLoad(row.id);
  return readState();
}

/** Hangs 3 kg or takes them off; on a real bench it marks that somebody did. */
export function toggleWeight(state: SessionState): Promise<boolean> {
  const isHung = hungWeights(state).length > 0;
  return perform(CONTROL.load, () =>
    isHung ? removeWeights(state) : addLoad(nextWeight(state.bench)),
  );
}
