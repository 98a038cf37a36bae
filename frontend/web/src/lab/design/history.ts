/** Undo of settings, references and loads: one step per change, of any user. */
import { effect, signal } from "@preact/signals";
import type { ArmPatch } from "../../core/api/arm";
import {
  addLoad,
  patchArm,
  putEffects,
  putGains,
  putLane,
  putLanes,
  putLaw,
  putObserver,
  putParameters,
  putPosition,
  putStiffness,
  readState,
  removeLoad,
  type SessionRequest,
} from "../../core/api/client";
import type { Edit } from "../../core/api/operations";
import type {
  Configuration,
  Effects,
  Joint,
  Lane,
  Law,
  Load,
  LoadRow,
  SessionState,
} from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { findChanges, isEqual } from "../../core/state/changes";
import { armOf, jointCountOf, listJoints, settingsOfJoint } from "../../core/state/joints";
import {
  comparisonLanes,
  comparisonLaws,
  comparisonsOf,
  hasOwnSettings,
} from "../../core/state/lanes";
import { isRealBench } from "../../core/state/plant";
import { session } from "../../core/state/session";

const MAX_STEPS = 50;

/** Settings of the single joint, or of a joint of an arm. parameters: by law. */
interface JointDesign {
  law: Law;
  effects: Effects;
  references: Pick<Configuration, "position" | "stiffness">;
  position: readonly number[];
  stiffness: readonly number[];
  observer: readonly [number, number, number];
  parameters: Readonly<Record<string, Record<string, unknown>>>;
}

/** joint: of an arm; null at its tip, and for a single joint. */
interface PlacedLoad {
  load: Load;
  joint: Joint | null;
}

/**
 * joints: one, or two of an arm. arm: its own settings; {} for a single joint. comparisons: by the
 * identity of the lane. loads: those that act on run `run`.
 */
interface Design {
  joints: readonly JointDesign[];
  arm: Pick<ArmPatch, "feedforward" | "adaptation" | "tip">;
  run: number;
  loads: readonly PlacedLoad[];
  comparisons: Readonly<Record<string, Lane>>;
}

export const steps = signal<readonly Design[]>([]);

let lastDesign: Design | null = null;
let isUndoing = false;

/**
 * Loads that software can remove: a real mass must be removed by hand, and a pulse ends
 * automatically.
 */
const undoableLoads = ({ bench, loads }: SessionState): LoadRow[] =>
  isRealBench(bench) ? [] : loads.filter(({ end_s: endS }) => endS === null);

/** The onset time is not part of the identity. */
const loadOf = ({ load, joint }: LoadRow): PlacedLoad => ({
  load: { ...load, start_s: null },
  joint,
});

function designOfJoint({ configuration }: Pick<SessionState, "configuration">): JointDesign {
  const { law, effects, position, stiffness, gains, observer, parameters } = configuration;
  return {
    law,
    effects,
    references: { position, stiffness },
    position: gains.position_coefficients,
    stiffness: gains.stiffness_coefficients,
    observer: observer.bandwidth_rad_per_s,
    parameters,
  };
}

/** The session with the settings of each joint. */
const statesOfJoints = (state: SessionState): SessionState[] =>
  listJoints(jointCountOf(state)).map((joint) => settingsOfJoint(state, joint));

export function designOf(state: SessionState): Design {
  const { feedforward, adaptation, tip } = armOf(state) ?? {};
  return {
    joints: statesOfJoints(state).map(designOfJoint),
    arm: armOf(state) === null ? {} : ({ feedforward, adaptation, tip } as Design["arm"]),
    run: state.run_number,
    loads: undoableLoads(state).map(loadOf),
    comparisons: Object.fromEntries(
      comparisonLanes(state).map(({ id, controller }) => [id, controller]),
    ),
  };
}

/** Laws of both designs with different settings. */
const changedLaws = (design: JointDesign, other: JointDesign): string[] =>
  Object.keys(design.parameters).filter(
    (law) => law in other.parameters && !isEqual(design.parameters[law], other.parameters[law]),
  );

/**
 * Lanes of both designs with different settings; if the law differs, only if settings were lost.
 */
const changedLanes = (design: Design, other: Design): string[] =>
  Object.keys(design.comparisons).filter((id) => {
    const [held, now] = [design.comparisons[id], other.comparisons[id]];
    if (held === undefined || now === undefined || isEqual(held, now)) return false;
    return held.law === now.law || hasOwnSettings(held);
  });

/** Removed lanes that had their own settings. */
const lostLanes = (design: Design, other: Design): string[] =>
  Object.keys(design.comparisons).filter(
    (id) => other.comparisons[id] === undefined && hasOwnSettings(design.comparisons[id] as Lane),
  );

/** Elements of `minuend` that `subtrahend` lacks, with multiplicity. */
function difference<T>(
  minuend: readonly T[],
  subtrahend: readonly unknown[],
  read: (element: T) => unknown,
) {
  const unmatched = subtrahend.map((element) => JSON.stringify(element));
  return minuend.filter((element) => {
    const at = unmatched.indexOf(JSON.stringify(read(element)));
    if (at >= 0) unmatched.splice(at, 1);
    return at < 0;
  });
}

/** A restarted run has no loads: undo does not restore those of the previous run. */
const lostLoads = (design: Design, other: Design): PlacedLoad[] =>
  design.run === other.run ? difference(design.loads, other.loads, (load) => load) : [];

const KEYS = ["law", "effects", "references", "position", "stiffness", "observer"] as const;

const differs = (key: (typeof KEYS)[number], design: JointDesign, other: JointDesign) =>
  !isEqual(design[key], other[key]);

const isSameJoint = (design: JointDesign, other: JointDesign | undefined): boolean =>
  other !== undefined &&
  !KEYS.some((key) => differs(key, design, other)) &&
  changedLaws(design, other).length === 0;

/**
 * Whether no undoable difference exists: removing a lane without its own settings is not undoable.
 */
export const isSame = (design: Design, other: Design): boolean =>
  design.joints.every((joint, index) => isSameJoint(joint, other.joints[index])) &&
  isEqual(design.arm, other.arm) &&
  lostLoads(design, other).length === 0 &&
  lostLoads(other, design).length === 0 &&
  changedLanes(design, other).length === 0 &&
  lostLanes(design, other).length === 0;

/** The steps after a change to `next`: the previous state is added. */
function appendStep(kept: readonly Design[], before: Design): Design[] {
  return [...kept, before].slice(-MAX_STEPS);
}

export function watchDesign(): void {
  effect(() => {
    const state = session.value;
    // Ending the excitation restores the references that it replaced.
    if (state === null || state.excitation) return;
    const design = designOf(state);
    if (lastDesign !== null && !isSame(lastDesign, design) && !isUndoing) {
      steps.value = appendStep(steps.peek(), lastDesign);
    }
    lastDesign = design;
  });
}

/** The requests that restore the settings of a joint, whose settings `state` has. */
function restoreJoint(design: JointDesign, state: SessionState): SessionRequest[] {
  const now = designOfJoint(state);
  const calls: SessionRequest[] = [];
  if (differs("law", design, now)) {
    calls.push(putLaw(design.law, comparisonLaws(design.law, state)));
  }
  if (differs("effects", design, now)) {
    calls.push(putEffects(design.effects));
  }
  if (!isEqual(design.references.position, now.references.position)) {
    calls.push(putPosition(design.references.position));
  }
  if (!isEqual(design.references.stiffness, now.references.stiffness)) {
    calls.push(putStiffness(design.references.stiffness));
  }
  if (differs("position", design, now) || differs("stiffness", design, now)) {
    const [c0, c1, c2, c3] = design.position as [number, number, number, number];
    const [s0, s1] = design.stiffness as [number, number];
    calls.push(
      putGains({ position_coefficients: [c0, c1, c2, c3], stiffness_coefficients: [s0, s1] }),
    );
  }
  if (differs("observer", design, now)) calls.push(putObserver(...design.observer));
  for (const law of changedLaws(design, now)) {
    calls.push(putParameters({ [law]: design.parameters[law] ?? {} }));
  }
  return calls;
}

/** The requests that restore a design: one for each part that differs from the current one. */
export function restoringRequests(design: Design, state: SessionState): SessionRequest[] {
  const now = designOf(state);
  if (design.joints.length !== now.joints.length) return [];
  const calls = statesOfJoints(state).flatMap((settings, index) => {
    const joint = armOf(state) === null ? null : index + 1;
    const ofJoint = restoreJoint(design.joints[index] as JointDesign, settings);
    return ofJoint.map(
      (call): SessionRequest =>
        (edit) =>
          call(edit.forJoint(joint)),
    );
  });
  if (!isEqual(design.arm, now.arm)) {
    const patch = patchArm(findChanges(design.arm, now.arm));
    // Joints accept a reference only while the tip has none.
    if (design.arm.tip) calls.push(patch);
    else calls.unshift(patch);
  }
  const lost = lostLanes(design, now).map((id) => design.comparisons[id] as Lane);
  if (lost.length > 0) calls.push(putLanes([...comparisonsOf(state), ...lost]));
  for (const id of changedLanes(design, now)) {
    const lane = comparisonLanes(state).find((candidate) => String(candidate.id) === id)?.lane;
    if (lane !== undefined) calls.push(putLane(lane, design.comparisons[id] as Lane));
  }
  // Last: a load changes the revision that settings are sent with.
  for (const { load, joint } of lostLoads(design, now)) {
    calls.push((edit) => addLoad(load)(edit.forJoint(joint)));
  }
  if (design.run === now.run) {
    for (const { id } of difference(undoableLoads(state), design.loads, loadOf)) {
      calls.push(() => removeLoad(id)().then(readState));
    }
  }
  return calls;
}

async function restoreDesign(
  design: Design,
  state: SessionState,
  edit: Edit,
): Promise<SessionState> {
  let reached = state;
  for (const call of restoringRequests(design, state)) reached = await call(edit);
  return reached;
}

/** Restore design, loads and lanes of a state; the run continues. */
export const restoreTo = (before: SessionState): Promise<boolean> =>
  perform("session", async (edit) => {
    // The page may be out of date: answers of a paused session can overtake each other.
    const state = await readState();
    const lanes = comparisonsOf(before);
    const reached = isEqual(lanes, comparisonsOf(state)) ? state : await putLanes(lanes)(edit);
    return restoreDesign({ ...designOf(before), comparisons: {} }, reached, edit);
  });

/** A restored lane has a new identity on the server: earlier steps are updated to it. */
function renameLanes(design: Design, names: ReadonlyMap<string, string>): Design {
  const comparisons = Object.entries(design.comparisons).map(([id, lane]) => [
    names.get(id) ?? id,
    lane,
  ]);
  return { ...design, comparisons: Object.fromEntries(comparisons) };
}

/** The steps without the last ones that equal `state`. */
function dropEqualSteps(state: SessionState): Design[] {
  const kept = [...steps.peek()];
  while (kept.length > 0 && restoringRequests(kept.at(-1) as Design, state).length === 0)
    kept.pop();
  return kept;
}

/** Undo one step, skipping those without a difference; resolves false if the server rejected it. */
export async function undo(): Promise<boolean> {
  const state = session.peek();
  if (state === null || isUndoing) return false;
  steps.value = dropEqualSteps(state);
  const last = steps.peek().at(-1);
  if (last === undefined) return false;
  const lost = lostLanes(last, designOf(state));
  let back: string[] = [];
  isUndoing = true;
  const isDone = await perform("design.undo", async (edit) => {
    const reached = await restoreDesign(last, state, edit);
    if (lost.length > 0) back = Object.keys(designOf(reached).comparisons).slice(-lost.length);
    return reached;
  });
  isUndoing = false;
  if (isDone) {
    const names = new Map(lost.map((id, index) => [id, back[index] ?? id]));
    const kept = steps.peek().slice(0, -1);
    steps.value = kept.map((step) => renameLanes(step, names));
  }
  return isDone;
}
