/** The second around the last event, fixed next to the scrolling plots. */
import { computed, effect, signal } from "@preact/signals";
import type { SessionEvent } from "../api/types";
import type { Cast } from "../state/lanes";
import { remember, remembered } from "../state/preferences";
import { samples, selectionCount, session } from "../state/session";
import type { SampleRing } from "../stream/ring";
import { type ChartView, held, shownCast, shownRing } from "./span";
import { mayShow, type Span } from "./spans";

const STORE = "svsa.event_zoom";
const BEFORE_S = 0.1;
const LENGTH_S = 1;

export const isZoomOn = signal(remembered(STORE) === "on");

export function toggleZoom(): void {
  isZoomOn.value = !isZoomOn.peek();
  remember(STORE, isZoomOn.peek() ? "on" : "off");
}

/** The last of them that is not after a time. */
const lastEvent = (events: readonly SessionEvent[], untilS: number): SessionEvent | null =>
  events.filter(({ time_s }) => time_s <= untilS).at(-1) ?? null;

const spanAround = ({ time_s }: SessionEvent): Span => ({
  from: time_s - BEFORE_S,
  to: time_s - BEFORE_S + LENGTH_S,
});

/** The last event of the session; while the plots stand still, the last before their right end. */
export const zoomedEvent = computed(() => {
  const state = session.value;
  return state === null
    ? null
    : lastEvent(state.events, held.value?.to ?? Number.POSITIVE_INFINITY);
});

/** Samples of an event whose second is over, kept when the session's ring has them no more. */
let kept: { run: number; timeS: number; ring: SampleRing; cast: Cast } | null = null;

function zoomedRing(): SampleRing {
  const event = zoomedEvent.peek();
  const run = session.peek()?.run_number ?? -1;
  if (held.peek() !== null || event === null) return shownRing();
  if (kept !== null && kept.run === run && kept.timeS === event.time_s) return kept.ring;
  const { ring } = samples;
  if (!(ring.newestTime >= spanAround(event).to)) return ring;
  kept = { run, timeS: event.time_s, ring: ring.copy(), cast: shownCast.peek() };
  return kept.ring;
}

/** The controllers of those samples: the session forgets those before the event after 60 s. */
export function zoomedCast(): Cast {
  const now = shownCast.value;
  void zoomedEvent.value;
  return kept !== null && zoomedRing() === kept.ring ? kept.cast : now;
}

export function zoomedSpan(): Span {
  const event = zoomedEvent.peek();
  return event === null ? { from: 0, to: LENGTH_S } : spanAround(event);
}

/** Whether any sample of it is held, or may still come. */
export const hasZoomed = (): boolean => mayShow(zoomedRing(), zoomedSpan());

export const EVENT_VIEW: ChartView = { ring: zoomedRing, span: zoomedSpan, hasCursors: false };

/** Channels that come later are zoomed too, as far as the session's ring has their past. */
export const followChannels = (): (() => void) =>
  effect(() => {
    void selectionCount.value;
    kept?.ring.adopt(samples.ring);
  });
