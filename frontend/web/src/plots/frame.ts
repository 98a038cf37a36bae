/**
 * One clock for all plots. Each frame draws those that have waited longest: all of them where that
 * is quick, else as many as keep each above ten drawings a second.
 */
import { effect } from "@preact/signals";
import { windowS } from "../state/preferences";
import { received, selectChannels, session } from "../state/session";
import { paceViews } from "./pace";
import { palette } from "./palette";
import { channelsInUse } from "./setups";
import { held, isHeld, shownSpan } from "./span";

export interface Drawing {
  draw(): void;
  /** Nobody sees what is scrolled out of sight. */
  isSeen(): boolean;
}

const FASTEST_MS = 1000 / 30;
const SLOWEST_MS = 75;
const QUICK_MS = 6;
/** Weight of the newest frame in the running mean of their distance. */
const NEWEST = 0.1;
const LONGEST_FRAME_MS = 250;

/** What is drawn last stands last; the version is that of the content drawn. */
const drawings = new Map<Drawing, number>();
const followers = new Set<() => void>();
let version = 0;
let versionAt = 0;
let drawnCount = -1;
let isStale = true;
let frameMs = FASTEST_MS;
let frameAt = 0;

/** Everything is drawn again with the next frames. */
export function redraw(): void {
  isStale = true;
}

/** Has it drawn whenever there is something new; returns the function that ends it. */
export function addDrawing(drawing: Drawing): () => void {
  drawings.set(drawing, -1);
  return () => drawings.delete(drawing);
}

/** Draws this one again. */
export function renew(drawing: Drawing): void {
  if (drawings.has(drawing)) drawings.set(drawing, -1);
}

/** Calls it in every frame that shows another span or other samples. */
export function onFrame(follower: () => void): () => void {
  followers.add(follower);
  isStale = true;
  return () => followers.delete(follower);
}

function noticeNews(now: number): boolean {
  const hasSamples = !isHeld.peek() && received.count !== drawnCount;
  if (!isStale && (!hasSamples || now - versionAt < FASTEST_MS - 2)) return false;
  isStale = false;
  drawnCount = received.count;
  versionAt = now;
  version++;
  return true;
}

function drawWaiting(): void {
  const waiting = [...drawings].filter(([drawing, drawn]) => drawn !== version && drawing.isSeen());
  const leastMany = Math.ceil((waiting.length * frameMs) / SLOWEST_MS);
  const begun = performance.now();
  for (const [index, [drawing]] of waiting.entries()) {
    if (index >= leastMany && performance.now() - begun > QUICK_MS) return;
    drawings.delete(drawing);
    drawings.set(drawing, version);
    drawing.draw();
  }
}

function tick(now: number): void {
  requestAnimationFrame(tick);
  frameMs += NEWEST * (Math.min(LONGEST_FRAME_MS, now - frameAt) - frameMs);
  frameAt = now;
  if (noticeNews(now)) for (const follow of followers) follow();
  drawWaiting();
}

/** From now on the stream carries what the plots need, and they are drawn. */
export function startFrames(): void {
  channelsInUse.subscribe(selectChannels);
  paceViews();
  effect(() => {
    void [windowS.value, palette.value, session.value, held.value];
    redraw();
  });
  requestAnimationFrame(tick);
}

/** Where a time is on the axis, 0 to 1 of what is seen. */
export function shareOf(timeS: number): number {
  const { from, to } = shownSpan();
  return (timeS - from) / (to - from);
}
