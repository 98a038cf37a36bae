/** The lanes of the session: controllers and their names. */
import { computed, effect, signal } from "@preact/signals";
import type { Gains, Lane, LaneRow, Law, SessionState } from "../api/types";
import { armOf, jointCountOf, nameArms, nameWithoutJoint } from "./joints";
import { defaultComparisonLaw } from "./laws";
import { session } from "./session";

/** The comparison lanes, without the simulated twin of a bench. */
export const comparisonsOf = ({ configuration: { comparisons }, bench }: SessionState) =>
  bench === null ? comparisons : comparisons.slice(1);

/** The comparison lane of this number. */
export interface ComparisonLane {
  lane: number;
  /** Id of the lane, constant during the run. */
  id: number;
  name: string;
  lineStyle: number;
  controller: Lane;
}

export function comparisonLanes(state: SessionState): ComparisonLane[] {
  const first = 1 + state.configuration.comparisons.length - comparisonsOf(state).length;
  return comparisonsOf(state).flatMap((controller, index) => {
    const row = state.lanes[jointCountOf(state) * (first + index)];
    const lane = first + index + 1;
    const lineStyle = row?.segments.at(-1)?.line_style ?? 0;
    const name = nameWithoutJoint(row?.name ?? "");
    return row ? [{ lane, id: row.id, name, lineStyle, controller }] : [];
  });
}

/** The gains of a lane: its own, or the session's if it has none. */
export function gainsOf({ gains }: Lane, { configuration }: SessionState): Gains {
  const { position_coefficients, stiffness_coefficients } = configuration.gains;
  return gains ?? ({ position_coefficients, stiffness_coefficients } as Gains);
}

/** Whether the lane has its own settings. */
export const hasOwnSettings = ({ gains, parameters, observer }: Lane): boolean =>
  [gains, parameters, observer].some((own) => own !== null && own !== undefined);

/**
 * The laws of the comparison lanes when the session changes to a law: the lane that has this law
 * takes the session's in exchange; each plant keeps its state. No change if no lane has the law, or
 * if that lane has its own settings: it is a different controller, and stays.
 */
export function comparisonLaws(law: Law, state: SessionState): Law[] {
  const { law: before, comparisons } = state.configuration;
  const twins = comparisons.length - comparisonsOf(state).length;
  const other = comparisons.findIndex(
    (comparison, index) => index >= twins && comparison.law === law && !hasOwnSettings(comparison),
  );
  if (other < 0) return [];
  return comparisons.map((comparison, index) => {
    if (index < twins) return law;
    return index === other ? before : comparison.law;
  });
}

/** A controller on a lane, from one time up to before another, s. */
export interface Segment {
  /** Number of the controller. */
  number: number;
  name: string;
  lineStyle: number;
  /** Whether its law uses an estimate of the disturbance. */
  hasEstimate: boolean;
  from: number;
  to: number;
}

/** Controllers of lanes 1, 2, … over time, the current one last. */
export type LaneSegments = readonly (readonly Segment[])[];

/** A string, so that dependents are recomputed only when a lane changes. */
const segmentsKey = computed(() =>
  JSON.stringify((session.value?.lanes ?? []).map(({ segments }) => segments)),
);

/** The same array until a lane changes. */
export const laneSegments = computed<LaneSegments>(() =>
  (JSON.parse(segmentsKey.value) as LaneRow["segments"][]).map((segments) =>
    segments.map(({ number, name, start_s: from, end_s: to, ...more }) => {
      const { line_style: lineStyle, has_estimate: hasEstimate } = more;
      return { number, name, lineStyle, hasEstimate, from, to: to ?? Number.POSITIVE_INFINITY };
    }),
  ),
);

/** Current controller of a lane. */
const currentSegment = (lane: readonly Segment[]): Segment | undefined => lane.at(-1);

/** Controller of a lane at a time. */
export const controllerAt = (lane: readonly Segment[], timeS: number): Segment | undefined =>
  lane.find(({ from, to }) => timeS >= from && timeS < to);

/** Current names of the controllers: of lanes 1, 2, …, or of each arm. */
export const controllerNames = computed(() => {
  const names = laneSegments.value.map((lane) => currentSegment(lane)?.name ?? "");
  const state = session.value;
  return state === null || armOf(state) === null ? names : nameArms(names, jointCountOf(state));
});

// The lanes that *Compare* switches on: the last comparison lanes, or the first other law.

const lastComparisons = signal<readonly Lane[]>([]);

/** Without a lane that equals the session's own controller. */
export function lanesToCompare(state: SessionState): readonly Lane[] {
  const { law } = state.configuration;
  const previous = lastComparisons.value.filter((lane) => lane.law !== law || hasOwnSettings(lane));
  const other = defaultComparisonLaw(law);
  if (previous.length > 0 || other === undefined) return previous;
  return [{ law: other }];
}

export const watchComparisons = (): (() => void) =>
  effect(() => {
    const { value: state } = session;
    if (state !== null && comparisonsOf(state).length > 0)
      lastComparisons.value = comparisonsOf(state);
  });
