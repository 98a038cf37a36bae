/** One clock for all plots: they show the same span of time and are drawn in the same frame. */
import { effect } from "@preact/signals";
import { windowS } from "../state/preferences";
import { LONGEST_WINDOW_S, RATE_HZ, received, samples, session } from "../state/session";
import { palette } from "./palette";

/** The span of time on screen and the samples in it. */
export interface TimeView {
  /** Limits of the axis, s. */
  from: number;
  to: number;
  /** Index in the ring of the first sample on screen. */
  first: number;
  time: Float64Array;
}

type Drawer = (view: TimeView) => void;

const FASTEST_MS = 1000 / 30;
const drawers = new Set<Drawer>();
const time = new Float64Array(LONGEST_WINDOW_S * RATE_HZ + 1);

let drawnCount = -1;
let drawnAt = 0;
let intervalMs = FASTEST_MS;
let isStale = true;

export function redraw(): void {
  isStale = true;
}

/** Draws whenever there is something new; returns the function that ends it. */
export function onFrame(drawer: Drawer): () => void {
  drawers.add(drawer);
  redraw();
  return () => drawers.delete(drawer);
}

function currentView(): TimeView {
  const { ring } = samples;
  const span = windowS.peek();
  const newest = Number.isNaN(ring.newestTime) ? 0 : ring.newestTime;
  const to = Math.max(newest, span);
  const first = Math.max(0, ring.firstAt(to - span) - 1);
  const count = ring.copyTime(first, time);
  return { from: to - span, to, first, time: time.subarray(0, count) };
}

function tick(now: number): void {
  requestAnimationFrame(tick);
  if (now - drawnAt < intervalMs - 2) return;
  if (!isStale && received.count === drawnCount) return;
  drawnAt = now;
  drawnCount = received.count;
  isStale = false;
  const begun = performance.now();
  const view = currentView();
  for (const draw of drawers) draw(view);
  // uPlot draws in microtasks queued before this one. On a slow machine at most half of the time
  // goes into drawing.
  queueMicrotask(() => {
    intervalMs = Math.max(FASTEST_MS, 2 * (performance.now() - begun));
  });
}

export function startFrames(): void {
  effect(() => {
    void [windowS.value, palette.value, session.value];
    redraw();
  });
  requestAnimationFrame(tick);
}
