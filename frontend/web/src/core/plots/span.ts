/** The time span that all plots show: it follows the newest sample, or it is frozen. */
import { computed, effect, signal } from "@preact/signals";
import { type LaneSegments, laneSegments } from "../state/lanes";
import { windowS } from "../state/preferences";
import { incrementReceived, samples, selectionCount, session } from "../state/session";
import type { SampleRing } from "../stream/ring";
import { clampSpan, liveSpan, type Span, zoomSpan } from "./spans";

/** Copied samples that frozen plots show, because those of the session advance. */
interface FrozenPlots extends Span {
  ring: SampleRing;
  laneSegments: LaneSegments;
}

export const frozen = signal<FrozenPlots | null>(null);
export const isFrozen = computed(() => frozen.value !== null);

/** The samples that the plots show. */
export const shownRing = (): SampleRing => frozen.peek()?.ring ?? samples.ring;

/** The controllers of the lanes whose samples the plots show. */
export const shownLaneSegments = computed<LaneSegments>(
  () => frozen.value?.laneSegments ?? laneSegments.value,
);

export const shownSpan = (): Span => frozen.peek() ?? liveSpan(samples.ring, windowS.peek());

/** Data of a chart: the samples, and the span. */
export interface ChartView {
  ring(): SampleRing;
  span(): Span;
  /** Whether the samples of the cursors are marked. */
  hasCursors: boolean;
}

export const PLOTS_VIEW: ChartView = { ring: shownRing, span: shownSpan, hasCursors: true };

/** Freeze the plots on a copy of the current samples. */
export function freeze(): void {
  if (frozen.peek() !== null) return;
  const span = shownSpan();
  const ring = samples.ring.copy();
  frozen.value = { ring, laneSegments: laneSegments.peek(), from: span.from, to: span.to };
}

export function goLive(): void {
  frozen.value = null;
}

export function showSpan(span: Span): void {
  freeze();
  const { ring, laneSegments } = frozen.peek() as FrozenPlots;
  frozen.value = { ring, laneSegments, ...clampSpan(span, ring.oldestTime, ring.newestTime) };
}

export function zoom(factor: number, around?: number): void {
  const span = shownSpan();
  showSpan(zoomSpan(span, factor, around ?? (span.from + span.to) / 2));
}

/** Move by a share of the span, positive to later times. */
export function pan(share: number): void {
  const { from, to } = shownSpan();
  const by = share * (to - from);
  showSpan({ from: from + by, to: to + by });
}

/** Set another length: a live span follows the newest sample, a frozen one keeps its middle. */
export function showLength(lengthS: number): void {
  const span = frozen.peek();
  if (span !== null) zoom(lengthS / (span.to - span.from));
}

/** Seconds by which the session has advanced since the plots were frozen. */
export const secondsBehind = (): number => {
  const span = frozen.peek();
  return span === null ? 0 : samples.ring.newestTime - span.ring.newestTime;
};

/**
 * A restarted run has no past, so the plots go live; channels and samples that arrive later
 * are added to the copy.
 */
export function followSession(): () => void {
  let run = session.peek()?.run_number;
  const stopRun = effect(() => {
    const next = session.value?.run_number;
    if (run !== undefined && next !== run) goLive();
    run = next;
  });
  const stopChannels = effect(() => {
    void selectionCount.value;
    const span = frozen.peek();
    if (span === null) return;
    span.ring.completeFrom(samples.ring);
    frozen.value = { ...span };
    incrementReceived();
  });
  return () => {
    stopRun();
    stopChannels();
  };
}
