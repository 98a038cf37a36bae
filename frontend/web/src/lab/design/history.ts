/** Previous gains, observer and law parameters: one step per change, of any user. */
import { effect, signal } from "@preact/signals";
import { putGains, putLane, putLanes, putObserver, putParameters } from "../../core/api/client";
import type { Lane, SessionState } from "../../core/api/types";
import { perform } from "../../core/state/actions";
import { comparisonLanes, comparisonsOf, hasOwnSettings } from "../../core/state/lanes";
import { session } from "../../core/state/session";

const MAX_STEPS = 50;

/** parameters: by law. comparisons: by the identity of the lane. */
interface Design {
  position: readonly number[];
  stiffness: readonly number[];
  observer: readonly [number, number, number];
  parameters: Readonly<Record<string, Record<string, unknown>>>;
  comparisons: Readonly<Record<string, Lane>>;
}

export const steps = signal<readonly Design[]>([]);

let known: Design | null = null;
let isUndoing = false;

export function designOf(state: SessionState): Design {
  const { gains, observer, parameters } = state.configuration;
  return {
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

const isOther = (key: "position" | "stiffness" | "observer", one: Design, other: Design) =>
  !isEqual(one[key], other[key]);

/** Whether nothing that can be taken back differs: a lane without settings of its own is not. */
export const isSame = (one: Design, other: Design): boolean =>
  !(["position", "stiffness", "observer"] as const).some((key) => isOther(key, one, other)) &&
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
    if (state === null) return;
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
  return calls;
}

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
    let reached = state;
    for (const call of callsBack(last, state)) reached = await call();
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
