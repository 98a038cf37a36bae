/** One second around the last event, static, next to the scrolling plots. */
import { computed, effect, signal } from "@preact/signals";
import type { SessionEvent } from "../api/types";
import type { LaneSegments } from "../state/lanes";
import { samples, selectionCount, session } from "../state/session";
import { readStored, store } from "../stored";
import type { SampleRing } from "../stream/ring";
import { type ChartView, frozen, shownLaneSegments, shownRing } from "./span";
import { mayHaveSamples, type Span } from "./spans";

const STORAGE_KEY = "svsa.event_zoom";
const BEFORE_S = 0.1;
const LENGTH_S = 1;

export const isZoomOn = signal(readStored(STORAGE_KEY) === "on");

export function toggleZoom(): void {
  isZoomOn.value = !isZoomOn.peek();
  store(STORAGE_KEY, isZoomOn.peek() ? "on" : "off");
}

/** The last event that is not after a time. */
const lastEvent = (events: readonly SessionEvent[], untilS: number): SessionEvent | null =>
  events.filter(({ time_s }) => time_s <= untilS).at(-1) ?? null;

const spanAround = ({ time_s }: SessionEvent): Span => ({
  from: time_s - BEFORE_S,
  to: time_s - BEFORE_S + LENGTH_S,
});

/** The last event of the session; while the plots are frozen, the last before their right end. */
export const zoomedEvent = computed(() => {
  const state = session.value;
  return state === null
    ? null
    : lastEvent(state.events, frozen.value?.to ?? Number.POSITIVE_INFINITY);
});

/** Samples of an event after its second, copied before the session's ring drops them. */
let eventSamples: {
  run: number;
  timeS: number;
  ring: SampleRing;
  laneSegments: LaneSegments;
} | null = null;

function zoomedRing(): SampleRing {
  const event = zoomedEvent.peek();
  const run = session.peek()?.run_number ?? -1;
  if (frozen.peek() !== null || event === null) return shownRing();
  if (eventSamples !== null && eventSamples.run === run && eventSamples.timeS === event.time_s)
    return eventSamples.ring;
  const { ring } = samples;
  if (!(ring.newestTime >= spanAround(event).to)) return ring;
  eventSamples = {
    run,
    timeS: event.time_s,
    ring: ring.copy(),
    laneSegments: shownLaneSegments.peek(),
  };
  return eventSamples.ring;
}

/** The controllers of those samples: the session drops those before the event after 60 s. */
export function zoomedLaneSegments(): LaneSegments {
  const now = shownLaneSegments.value;
  void zoomedEvent.value;
  return eventSamples !== null && zoomedRing() === eventSamples.ring
    ? eventSamples.laneSegments
    : now;
}

export function zoomedSpan(): Span {
  const event = zoomedEvent.peek();
  return event === null ? { from: 0, to: LENGTH_S } : spanAround(event);
}

/** Whether any sample of the span is stored or may still come. */
export function mayHaveZoomedSamples(): boolean {
  void selectionCount.value;
  return mayHaveSamples(zoomedRing(), zoomedSpan());
}

export const EVENT_VIEW: ChartView = { ring: zoomedRing, span: zoomedSpan, hasCursors: false };

/** Channels and samples that arrive later are zoomed, too, as far back as the ring contains them. */
export const followChannels = (): (() => void) =>
  effect(() => {
    void selectionCount.value;
    eventSamples?.ring.completeFrom(samples.ring);
  });
