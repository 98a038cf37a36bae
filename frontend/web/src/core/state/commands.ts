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
import type { Lane, Law, SessionState } from "../api/types";
import { perform } from "./actions";
import { comparedWith, comparisonLanes, comparisonsOf, gainsOf } from "./lanes";
import { lawOf } from "./laws";
import { hungWeights, nextWeight } from "./plant";
import { session } from "./session";

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
  const isOn = comparisonsOf(state).length > 0;
  return perform(CONTROL.compare, () => putLanes(isOn ? [] : comparedWith(state)));
}

/** Adds a comparison lane; the session's own law gets a copy of the present settings. */
export function addLane(state: SessionState, law: Law): Promise<boolean> {
  const { configuration } = state;
  const lane: Lane = { law };
  if (law === configuration.law && lawOf(law)?.takes_gains) lane.gains = gainsOf(lane, state);
  else if (law === configuration.law) lane.parameters = configuration.parameters[law] ?? {};
  return perform(CONTROL.compare, () => putLanes([...comparisonsOf(state), lane]));
}

export function removeLane(state: SessionState, lane: number): Promise<boolean> {
  const kept = comparisonLanes(state).filter((one) => one.lane !== lane);
  return perform(CONTROL.compare, () => putLanes(kept.map(({ controller }) => controller)));
}

async function removeWeights(state: SessionState): Promise<SessionState> {
  for (const row of hungWeights(state)) await removeLoad(row.id);
  return readState();
}

/** A press waits for what the one before has done: of a button and its key at once both would hang 3 kg. */
let answered: Promise<boolean> = Promise.resolve(true);

/** Adds or removes the 3 kg; on a real bench it marks that the operator did. */
export function toggleWeight(): Promise<boolean> {
  answered = answered.then(() => {
    const state = session.peek();
    if (state === null) return false;
    const isHung = hungWeights(state).length > 0;
    return perform(CONTROL.load, () =>
      isHung ? removeWeights(state) : addLoad(nextWeight(state)),
    );
  });
  return answered;
}
