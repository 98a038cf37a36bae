/** The lanes of the session: what runs side by side, and under which names. */
import { computed, effect, signal } from "@preact/signals";
import type { Gains, Lane, LaneRow, Law, SessionState } from "../api/types";
import { otherLaw } from "./laws";
import { session } from "./session";

/** The comparison lanes; a bench's simulated twin is not one of them. */
export const comparisonsOf = ({ configuration: { comparisons }, bench }: SessionState) =>
  bench === null ? comparisons : comparisons.slice(1);

/** The comparison lane of this number. */
export interface ComparisonLane {
  lane: number;
  /** The lane's own in the whole run. */
  id: number;
  name: string;
  lineStyle: number;
  controller: Lane;
}

export function comparisonLanes(state: SessionState): ComparisonLane[] {
  const first = 1 + state.configuration.comparisons.length - comparisonsOf(state).length;
  return comparisonsOf(state).flatMap((controller, index) => {
    const row = state.lanes[first + index];
    const lane = first + index + 1;
    const lineStyle = row?.segments.at(-1)?.line_style ?? 0;
    return row ? [{ lane, id: row.id, name: row.name, lineStyle, controller }] : [];
  });
}

/** The gains of a lane: its own, or the session's while it has none. */
export function gainsOf({ gains }: Lane, { configuration }: SessionState): Gains {
  const { position_coefficients, stiffness_coefficients } = configuration.gains;
  return gains ?? ({ position_coefficients, stiffness_coefficients } as Gains);
}

/** Whether something of it is its own, and not the session's. */
export const hasOwnSettings = ({ gains, parameters, observer }: Lane): boolean =>
  [gains, parameters, observer].some((own) => own !== null && own !== undefined);

/**
 * The laws of the comparison lanes when the session takes a law: the lane that has it takes the
 * session's in exchange, each from where its actuator is. None where no lane has it, or where it
 * is set there otherwise: that is another controller, which stays.
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

/** A controller on a lane, from a time on up to before another, s. */
export interface Segment {
  /** Which controller. */
  number: number;
  name: string;
  lineStyle: number;
  /** Its law acts on an estimate of the disturbance. */
  hasEstimate: boolean;
  from: number;
  to: number;
}

/** Of lane 1, 2, … who controlled it when, the present one last. */
export type Cast = readonly (readonly Segment[])[];

/** A string, so that its dependents are computed again only when a lane changes. */
const castKey = computed(() =>
  JSON.stringify((session.value?.lanes ?? []).map(({ segments }) => segments)),
);

/** The same array until a lane changes. */
export const cast = computed<Cast>(() =>
  (JSON.parse(castKey.value) as LaneRow["segments"][]).map((segments) =>
    segments.map(({ number, name, start_s: from, end_s: to, ...more }) => {
      const { line_style: lineStyle, has_estimate: hasEstimate } = more;
      return { number, name, lineStyle, hasEstimate, from, to: to ?? Number.POSITIVE_INFINITY };
    }),
  ),
);

/** Who controls a lane now. */
const presentOf = (lane: readonly Segment[]): Segment | undefined => lane.at(-1);

/** Who controlled a lane at a time. */
export const controllerAt = (lane: readonly Segment[], timeS: number): Segment | undefined =>
  lane.find(({ from, to }) => timeS >= from && timeS < to);

/** Names of lane 1, 2, … as they are now. */
export const laneNames = computed(() => cast.value.map((lane) => presentOf(lane)?.name ?? ""));

// What *Compare* switches on: the last comparison lanes, or the first other law.

const last = signal<readonly Lane[]>([]);

/** Without what would be the session's own controller a second time. */
export function comparedWith(state: SessionState): readonly Lane[] {
  const { law } = state.configuration;
  const kept = last.value.filter((lane) => lane.law !== law || hasOwnSettings(lane));
  const other = otherLaw(law);
  if (kept.length > 0 || other === undefined) return kept;
  return [{ law: other }];
}

export const watchComparisons = (): (() => void) =>
  effect(() => {
    const { value: state } = session;
    if (state !== null && comparisonsOf(state).length > 0) last.value = comparisonsOf(state);
  });
