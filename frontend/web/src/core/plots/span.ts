/** The span of time that all plots show: it follows the newest sample, or it is held. */
import { computed, effect, signal } from "@preact/signals";
import { type Cast, cast } from "../state/lanes";
import { windowS } from "../state/preferences";
import { countReceived, samples, selectionCount, session } from "../state/session";
import type { SampleRing } from "../stream/ring";
import { keepInside, liveSpan, type Span, zoomSpan } from "./spans";

/** What the plots stand still on: samples of their own, for those of the session go on. */
interface Held extends Span {
  ring: SampleRing;
  cast: Cast;
}

export const held = signal<Held | null>(null);
export const isHeld = computed(() => held.value !== null);

/** The samples that the plots show. */
export const shownRing = (): SampleRing => held.peek()?.ring ?? samples.ring;

/** Who controlled the lanes whose samples the plots show. */
export const shownCast = computed<Cast>(() => held.value?.cast ?? cast.value);

export const shownSpan = (): Span => held.peek() ?? liveSpan(samples.ring, windowS.peek());

/** What a chart draws: which samples, and from when to when. */
export interface ChartView {
  ring(): SampleRing;
  span(): Span;
  /** The cursors' samples are marked. */
  hasCursors: boolean;
}

export const PLOTS_VIEW: ChartView = { ring: shownRing, span: shownSpan, hasCursors: true };

/** The plots stand still, on a copy of what is there now. */
export function hold(): void {
  if (held.peek() !== null) return;
  const span = shownSpan();
  const ring = samples.ring.copy();
  held.value = { ring, cast: cast.peek(), from: span.from, to: span.to };
}

export function goLive(): void {
  held.value = null;
}

export function showSpan(span: Span): void {
  hold();
  const { ring, cast } = held.peek() as Held;
  held.value = { ring, cast, ...keepInside(span, ring.oldestTime, ring.newestTime) };
}

export function zoom(factor: number, around?: number): void {
  const span = shownSpan();
  showSpan(zoomSpan(span, factor, around ?? (span.from + span.to) / 2));
}

/** Moves by a share of the span: 1 is a whole one, to later times. */
export function pan(share: number): void {
  const { from, to } = shownSpan();
  const by = share * (to - from);
  showSpan({ from: from + by, to: to + by });
}

/** Another length: live it follows, held it stays around its middle. */
export function showLength(lengthS: number): void {
  const span = held.peek();
  if (span !== null) zoom(lengthS / (span.to - span.from));
}

/** Seconds that the data have gone on since the plots stand still. */
export const behindS = (): number => {
  const span = held.peek();
  return span === null ? 0 : samples.ring.newestTime - span.ring.newestTime;
};

/** A restarted run has no past to pause on; new channels get their past there, too. */
export function followSession(): () => void {
  let run = session.peek()?.run_number;
  const stopRun = effect(() => {
    const next = session.value?.run_number;
    if (run !== undefined && next !== run) goLive();
    run = next;
  });
  const stopChannels = effect(() => {
    void selectionCount.value;
    const span = held.peek();
    if (span === null) return;
    span.ring.adopt(samples.ring);
    held.value = { ...span };
    countReceived();
  });
  return () => {
    stopRun();
    stopChannels();
  };
}
