/**
 * One clock for all plots, which runs while there is something to draw. Each frame draws those that
 * have waited longest: all of them where that is quick, else as many as keep each above ten drawings
 * a second.
 */
import { effect } from "@preact/signals";
import { windowS } from "../state/preferences";
import { received, selectChannels, session } from "../state/session";
import { cursorSamples } from "./cursors";
import { palette } from "./linestyles";
import { paceViews } from "./pace";
import { channelsInUse } from "./setups";
import { held, isHeld, shownSpan } from "./span";

/** What is drawn whenever there is something new. */
interface Drawing {
  /** Draws it again. */
  renew(): void;
  /** A plot scrolled out of view is not drawn. */
  see(isSeen: boolean): void;
  remove(): void;
}

interface Drawn {
  draw(): void;
  isSeen: boolean;
  /** Of the content drawn. */
  version: number;
}

const FASTEST_MS = 1000 / 30;
const SLOWEST_MS = 75;
const QUICK_MS = 6;
/** Weight of the newest frame in the running mean of their distance. */
const NEWEST = 0.1;
const LONGEST_FRAME_MS = 250;
const NEVER = -1;

/** What is drawn last stands last. */
const drawings = new Set<Drawn>();
const followers = new Set<() => void>();
let version = 0;
let versionAt = 0;
let drawnCount = NEVER;
let isStale = true;
let isAsked = false;
let frameMs = FASTEST_MS;
let frameAt = 0;

/** Has it drawn, now and whenever there is something new. */
export function addDrawing(draw: () => void): Drawing {
  const drawn: Drawn = { draw, isSeen: true, version: NEVER };
  drawings.add(drawn);
  askWhereDue();
  return {
    renew: () => {
      drawn.version = NEVER;
      askWhereDue();
    },
    see: (isSeen) => {
      drawn.isSeen = isSeen;
      askWhereDue();
    },
    remove: () => drawings.delete(drawn),
  };
}

/** Calls it in every frame that shows another span or other samples. */
export function onFrame(follower: () => void): () => void {
  followers.add(follower);
  isStale = true;
  askWhereDue();
  return () => followers.delete(follower);
}

const isNew = (): boolean => isStale || (!isHeld.peek() && received.peek() !== drawnCount);

const listWaiting = (): Drawn[] =>
  [...drawings].filter((one) => one.version !== version && one.isSeen);

/** The only place that asks for a frame: after all that may have made one due, the last one too. */
function askWhereDue(): void {
  const isFollowed = drawings.size + followers.size > 0;
  if (isAsked || !((isFollowed && isNew()) || listWaiting().length > 0)) return;
  isAsked = true;
  requestAnimationFrame(tick);
}

function noticeNewSamples(now: number): boolean {
  if (!isNew() || (!isStale && now - versionAt < FASTEST_MS - 2)) return false;
  isStale = false;
  drawnCount = received.peek();
  versionAt = now;
  version++;
  return true;
}

function drawWaiting(): void {
  const waiting = listWaiting();
  const leastMany = Math.ceil((waiting.length * frameMs) / SLOWEST_MS);
  const begun = performance.now();
  for (const [index, one] of waiting.entries()) {
    if (index >= leastMany && performance.now() - begun > QUICK_MS) return;
    drawings.delete(one);
    drawings.add(one);
    one.version = version;
    one.draw();
  }
}

function tick(now: number): void {
  isAsked = false;
  frameMs += NEWEST * (Math.min(LONGEST_FRAME_MS, now - frameAt) - frameMs);
  frameAt = now;
  if (noticeNewSamples(now)) for (const follow of followers) follow();
  drawWaiting();
  askWhereDue();
}

/** From now on the stream carries what the plots need, and they are drawn. */
export function startFrames(): void {
  channelsInUse.subscribe(selectChannels);
  paceViews();
  effect(() => {
    void [windowS.value, palette.value, session.value, held.value, cursorSamples.value];
    isStale = true;
    askWhereDue();
  });
  received.subscribe(askWhereDue);
}

/** Where a time is on the axis, 0 to 1 of what is seen. */
export function shareOf(timeS: number): number {
  const { from, to } = shownSpan();
  return (timeS - from) / (to - from);
}
