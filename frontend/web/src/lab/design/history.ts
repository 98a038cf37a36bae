/** Previous settings, references and loads: one step per change, of any user. */
import { effect, signal } from "@preact/signals";
import {
  addLoad,
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
} from "../../core/api/client";
import type {
  Configuration,
  Effects,
  Lane,
  Law,
  Load,
  LoadRow,
  SessionState,
} from "../../core/api/types";
import { perform } from "../../core/state/actions";
import {
  comparisonLanes,
  comparisonLaws,
  comparisonsOf,
  hasOwnSettings,
} from "../../core/state/lanes";
import { isRealBench } from "../../core/state/plant";
import { session } from "../../core/state/session";

const MAX_STEPS = 50;

/** parameters: by law. comparisons: by the identity of the lane. loads: those that stay, of run `run`. */
interface Design {
  law: Law;
  effects: Effects;
  references: Pick<Configuration, "position" | "stiffness">;
  run: number;
  loads: readonly Load[];
  position: readonly number[];
  stiffness: readonly number[];
  observer: readonly [number, number, number];
  parameters: Readonly<Record<string, Record<string, unknown>>>;
  comparisons: Readonly<Record<string, Lane>>;
}

export const steps = signal<readonly Design[]>([]);

let known: Design | null = null;
let isUndoing = false;

/** The loads that software can remove: one on a real bench hangs there, and a pulse ends itself. */
const stayingLoads = ({ bench, loads }: SessionState): LoadRow[] =>
  isRealBench(bench) ? [] : loads.filter(({ end_s: endS }) => endS === null);

/** When it came is not part of what it is. */
const loadOf = ({ load }: LoadRow): Load => ({ ...load, start_s: null });

export function designOf(state: SessionState): Design {
  const { law, effects, position, stiffness, gains, observer, parameters } = state.configuration;
  return {
    law,
    effects,
    references: { position, stiffness },
    run: state.run_number,
    loads: stayingLoads(state).map(loadOf),
    position: gains.position_coefficients,
    stiffness: gains.stiffness_coefficients,
    observer: observer.bandwidth_rad_per_s,
    parameters,
    comparisons: Object.fromEntries(
      comparisonLanes(state).map(({ id, controller }) => [id, controller]),
    ),
  };
}

const isEqual = (one: unknown, other: unknown): boolean =>
  JSON.stringify(one) === JSON.stringify(other);

/** The laws that both designs know, and that are set differently. */
const changedLaws = (one: Design, other: Design): string[] =>
  Object.keys(one.parameters).filter(
    (law) => law in other.parameters && !isEqual(one.parameters[law], other.parameters[law]),
  );

/** The lanes that both designs have, set differently; under another law if settings went. */
const changedLanes = (one: Design, other: Design): string[] =>
  Object.keys(one.comparisons).filter((id) => {
    const [held, now] = [one.comparisons[id], other.comparisons[id]];
    if (held === undefined || now === undefined || isEqual(held, now)) return false;
    return held.law === now.law || hasOwnSettings(held);
  });

/** The lanes with settings of their own that are no more. */
const lostLanes = (one: Design, other: Design): string[] =>
  Object.keys(one.comparisons).filter(
    (id) => other.comparisons[id] === undefined && hasOwnSettings(one.comparisons[id] as Lane),
  );

/** Those of `some` that are not among `others`, each as often as it is missing. */
function without<T>(some: readonly T[], others: readonly unknown[], read: (one: T) => unknown) {
  const left = others.map((one) => JSON.stringify(one));
  return some.filter((one) => {
    const at = left.indexOf(JSON.stringify(read(one)));
    if (at >= 0) left.splice(at, 1);
    return at < 0;
  });
}

/** A run that begins again begins without its loads: they do not come back with it. */
const lostLoads = (one: Design, other: Design): Load[] =>
  one.run === other.run ? without(one.loads, other.loads, (load) => load) : [];

const KEYS = ["law", "effects", "references", "position", "stiffness", "observer"] as const;

const isOther = (key: (typeof KEYS)[number], one: Design, other: Design) =>
  !isEqual(one[key], other[key]);

/** Whether nothing that can be taken back differs: a lane without settings of its own is not. */
export const isSame = (one: Design, other: Design): boolean =>
  !KEYS.some((key) => isOther(key, one, other)) &&
  lostLoads(one, other).length === 0 &&
  lostLoads(other, one).length === 0 &&
  changedLaws(one, other).length === 0 &&
  changedLanes(one, other).length === 0 &&
  lostLanes(one, other).length === 0;

/** The steps after a change to `next`: the one before it is kept. */
function keepStep(kept: readonly Design[], before: Design): Design[] {
  return [...kept, before].slice(-MAX_STEPS);
}

export function watchDesign(): void {
  effect(() => {
    const state = session.value;
    // The excitation brings back automatically what it replaces.
    if (state === null || state.excitation) return;
    const design = designOf(state);
    if (known !== null && !isSame(known, design) && !isUndoing) {
      steps.value = keepStep(steps.peek(), known);
    }
    known = design;
  });
}

/** The calls that bring a design back: one for each part that differs from what is there now. */
export function callsBack(design: Design, state: SessionState): (() => Promise<SessionState>)[] {
  const now = designOf(state);
  const calls: (() => Promise<SessionState>)[] = [];
  if (isOther("law", design, now)) {
    calls.push(() => putLaw(design.law, comparisonLaws(design.law, state)));
  }
  if (isOther("effects", design, now)) {
    calls.push(() => putEffects(design.effects));
  }
  if (!isEqual(design.references.position, now.references.position)) {
    calls.push(() => putPosition(design.references.position));
  }
  if (!isEqual(design.references.stiffness, now.references.stiffness)) {
    calls.push(() => putStiffness(design.references.stiffness));
  }
  const lost = lostLanes(design, now).map((id) => design.comparisons[id] as Lane);
  if (lost.length > 0) calls.push(() => putLanes([...comparisonsOf(state), ...lost]));
  if (isOther("position", design, now) || isOther("stiffness", design, now)) {
    const [c0, c1, c2, c3] = design.position as [number, number, number, number];
    const [s0, s1] = design.stiffness as [number, number];
    calls.push(() =>
      putGains({ position_coefficients: [c0, c1, c2, c3], stiffness_coefficients: [s0, s1] }),
    );
  }
  if (isOther("observer", design, now)) calls.push(() => putObserver(...design.observer));
  for (const law of changedLaws(design, now)) {
    calls.push(() => putParameters({ [law]: design.parameters[law] ?? {} }));
  }
  for (const id of changedLanes(design, now)) {
    const lane = comparisonLanes(state).find((one) => String(one.id) === id)?.lane;
    if (lane !== undefined) calls.push(() => putLane(lane, design.comparisons[id] as Lane));
  }
  // Last: a load changes the revision that settings are sent with.
  for (const load of lostLoads(design, now)) calls.push(() => addLoad(load));
  if (design.run === now.run) {
    for (const { id } of without(stayingLoads(state), design.loads, loadOf)) {
      calls.push(() => removeLoad(id).then(readState));
    }
  }
  return calls;
}

async function bringBack(design: Design, state: SessionState): Promise<SessionState> {
  let reached = state;
  for (const call of callsBack(design, state)) reached = await call();
  return reached;
}

/** Restores design, loads and lanes of a state; the run continues. */
export const restoreTo = (before: SessionState): Promise<boolean> =>
  perform("session", async () => {
    // The page may know less than the server: answers of a session at rest can overtake each other.
    const state = await readState();
    const lanes = comparisonsOf(before);
    const reached = isEqual(lanes, comparisonsOf(state)) ? state : await putLanes(lanes);
    return bringBack({ ...designOf(before), comparisons: {} }, reached);
  });

/** A lane that is brought back is another one to the server: earlier steps learn its identity. */
function renameLanes(design: Design, names: ReadonlyMap<string, string>): Design {
  const comparisons = Object.entries(design.comparisons).map(([id, lane]) => [
    names.get(id) ?? id,
    lane,
  ]);
  return { ...design, comparisons: Object.fromEntries(comparisons) };
}

/** Back by one step, past those that have nothing left; resolves false where the server refused. */
export async function undo(): Promise<boolean> {
  const state = session.peek();
  if (state === null || isUndoing) return false;
  steps.value = steps.peek().filter((step) => callsBack(step, state).length > 0);
  const last = steps.peek().at(-1);
  if (last === undefined) return false;
  const lost = lostLanes(last, designOf(state));
  let back: string[] = [];
  isUndoing = true;
  const isDone = await perform("design.undo", async () => {
    const reached = await bringBack(last, state);
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
