/**
 * One clock for all plots, active while there is something to draw. Each frame draws the plots that
 * have waited longest: all if that is fast enough, otherwise as many as give each plot more than
 * ten frames per second.
 */
import { effect } from "@preact/signals";
import { windowS } from "../state/preferences";
import { receivedCount, selectChannels, session } from "../state/session";
import { cursorSamples } from "./cursors";
import { throttleViews } from "./framepacing";
import { palette } from "./linestyles";
import { channelsInUse } from "./setups";
import { frozen, isFrozen, shownSpan } from "./span";

/** A part that is drawn when new data arrive. */
interface Drawing {
  /** Draw it. */
  redraw(): void;
  /** A plot that is scrolled out of view is not drawn. */
  setVisible(isVisible: boolean): void;
  remove(): void;
}

interface DrawingState {
  draw(): void;
  isVisible: boolean;
  /** Version of the content drawn. */
  version: number;
}

const MIN_INTERVAL_MS = 1000 / 30;
const MAX_INTERVAL_MS = 75;
const DRAW_BUDGET_MS = 6;
/** Weight of the newest frame in the moving average of the frame time. */
const AVERAGE_WEIGHT = 0.1;
const MAX_FRAME_MS = 250;
const NEVER = -1;

/** The part drawn last is at the end. */
const drawings = new Set<DrawingState>();
const followers = new Set<() => void>();
let version = 0;
let versionAt = 0;
let drawnReceivedCount = NEVER;
let isStale = true;
let isFrameRequested = false;
let frameMs = MIN_INTERVAL_MS;
let frameAt = 0;

/** Register a part; it is drawn now and when new data arrive. */
export function addDrawing(draw: () => void): Drawing {
  const state: DrawingState = { draw, isVisible: true, version: NEVER };
  drawings.add(state);
  requestFrameIfDue();
  return {
    redraw: () => {
      state.version = NEVER;
      requestFrameIfDue();
    },
    setVisible: (isVisible) => {
      state.isVisible = isVisible;
      requestFrameIfDue();
    },
    remove: () => drawings.delete(state),
  };
}

/** Call it in every frame that shows another span or other samples. */
export function onFrame(follower: () => void): () => void {
  followers.add(follower);
  isStale = true;
  requestFrameIfDue();
  return () => followers.delete(follower);
}

const hasNewSamples = (): boolean =>
  isStale || (!isFrozen.peek() && receivedCount.peek() !== drawnReceivedCount);

const listWaiting = (): DrawingState[] =>
  [...drawings].filter((drawing) => drawing.version !== version && drawing.isVisible);

/** Request a frame; the only caller, so that all changes of one task share a frame. */
function requestFrameIfDue(): void {
  const isFollowed = drawings.size + followers.size > 0;
  if (isFrameRequested || !((isFollowed && hasNewSamples()) || listWaiting().length > 0)) return;
  isFrameRequested = true;
  requestAnimationFrame(tick);
}

function updateVersion(now: number): boolean {
  if (!hasNewSamples() || (!isStale && now - versionAt < MIN_INTERVAL_MS - 2)) return false;
  isStale = false;
  drawnReceivedCount = receivedCount.peek();
  versionAt = now;
  version++;
  return true;
}

function drawWaiting(): void {
  const waiting = listWaiting();
  const minCount = Math.ceil((waiting.length * frameMs) / MAX_INTERVAL_MS);
  const startedAt = performance.now();
  for (const [index, drawing] of waiting.entries()) {
    if (index >= minCount && performance.now() - startedAt > DRAW_BUDGET_MS) return;
    drawings.delete(drawing);
    drawings.add(drawing);
    drawing.version = version;
    drawing.draw();
  }
}

function tick(now: number): void {
  isFrameRequested = false;
  frameMs += AVERAGE_WEIGHT * (Math.min(MAX_FRAME_MS, now - frameAt) - frameMs);
  frameAt = now;
  if (updateVersion(now)) for (const follow of followers) follow();
  drawWaiting();
  requestFrameIfDue();
}

/** Start: the stream carries the channels of the plots, and they are drawn. */
export function startFrames(): void {
  channelsInUse.subscribe(selectChannels);
  throttleViews();
  effect(() => {
    void [windowS.value, palette.value, session.value, frozen.value, cursorSamples.value];
    isStale = true;
    requestFrameIfDue();
  });
  receivedCount.subscribe(requestFrameIfDue);
}

/** Position of a time on the axis, 0 to 1 of the visible span. */
export function shareOf(timeS: number): number {
  const { from, to } = shownSpan();
  return (timeS - from) / (to - from);
}
