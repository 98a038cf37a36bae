/** Commands that have both a button and a key. */
import {
  addLoad,
  pause,
  putLanes,
  readState,
  removeLoad,
  type SessionRequest,
  start,
  startRecording,
  stopRecording,
} from "../api/client";
import type { Lane, Law, LoadRow, SessionState } from "../api/types";
import { perform } from "./actions";
import { armOf } from "./joints";
import { comparisonLanes, comparisonsOf, gainsOf, lanesToCompare } from "./lanes";
import { lawOf } from "./laws";
import { activeWeights, nextWeight, scheduledWeights } from "./plant";
import { session } from "./session";

/** Names of the controls that show why a command was rejected. */
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
  return perform(CONTROL.compare, putLanes(isOn ? [] : lanesToCompare(state)));
}

/** Add a comparison lane; with the law of lane 1 it gets a copy of its settings. */
export function addLane(state: SessionState, law: Law): Promise<boolean> {
  const { configuration } = state;
  const lane: Lane = { law };
  if (law === configuration.law && lawOf(law)?.takes_gains) lane.gains = gainsOf(lane, state);
  else if (law === configuration.law) lane.parameters = configuration.parameters[law] ?? {};
  return perform(CONTROL.compare, putLanes([...comparisonsOf(state), lane]));
}

export function removeLane(state: SessionState, lane: number): Promise<boolean> {
  const remaining = comparisonLanes(state).filter((row) => row.lane !== lane);
  return perform(CONTROL.compare, putLanes(remaining.map(({ controller }) => controller)));
}

async function removeRows(rows: readonly LoadRow[]): Promise<SessionState> {
  for (const row of rows) await removeLoad(row.id)();
  return readState();
}

/** The load acts now instead of at its scheduled time; masses at the tip of an arm add up. */
const addWeight =
  (state: SessionState): SessionRequest =>
  async (edit) => {
    const added = await addLoad(nextWeight(state))(edit);
    return armOf(state) === null ? removeRows(scheduledWeights(state)) : added;
  };

/**
 * A command waits for the previous one: a button and its key at the same time would both add 3 kg.
 */
let pending: Promise<boolean> = Promise.resolve(true);

/** Add or remove the 3 kg; on a real bench it marks that the operator has done so. */
export function toggleWeight(): Promise<boolean> {
  pending = pending.then(() => {
    const state = session.peek();
    if (state === null) return false;
    const isWeightActive = activeWeights(state).length > 0;
    return perform(
      CONTROL.load,
      isWeightActive ? () => removeRows(activeWeights(state)) : addWeight(state),
    );
  });
  return pending;
}
