/** The time of the page, and the part of the run that the plots show. */
import { signal } from "@preact/signals";

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4] as const;

interface Range {
  from: number;
  to: number;
}

const SHORTEST_RANGE_S = 0.05;
/** If not every sample is drawn, a plot spans at least this number of points. */
const MIN_POINTS = 400;

export const timeS = signal(0);
export const isPlaying = signal(false);
export const speed = signal<number>(1);
export const range = signal<Range>({ from: 0, to: 1 });

let endS = 0;
let frameS = 1 / 30;
let playedAt = 0;
let shortestS = SHORTEST_RANGE_S;

interface Timing {
  /** Time of the run's last sample, s. */
  endS: number;
  /** Time between two frames of the 3D view, s. */
  frameS: number;
  /** Time between two points of a curve, s. */
  pointS: number;
  isEverySample: boolean;
}

export function setUpClock(timing: Timing): void {
  endS = timing.endS;
  frameS = timing.frameS;
  shortestS = timing.isEverySample
    ? SHORTEST_RANGE_S
    : Math.max(SHORTEST_RANGE_S, MIN_POINTS * timing.pointS);
  showAll();
}

export function seek(time: number): void {
  timeS.value = Math.min(Math.max(time, 0), endS);
  follow();
}

/** Move by whole frames from the current one. */
function stepFrames(count: number): void {
  isPlaying.value = false;
  seek((Math.round(timeS.peek() / frameS) + count) * frameS);
}

export function togglePlay(): void {
  if (!isPlaying.peek() && timeS.peek() >= endS) seek(0);
  isPlaying.value = !isPlaying.peek();
  if (isPlaying.peek()) {
    playedAt = performance.now();
    requestAnimationFrame(play);
  }
}

export function showAll(): void {
  range.value = { from: 0, to: Math.max(endS, shortestS) };
}

export function isWholeRun({ from, to }: Range): boolean {
  return from <= 0 && to >= endS;
}

export function showRange(from: number, to: number): void {
  const width = Math.min(Math.max(to - from, shortestS), Math.max(endS, shortestS));
  const start = Math.min(Math.max((from + to - width) / 2, 0), Math.max(endS - width, 0));
  range.value = { from: start, to: start + width };
}

/** Zoom in (factor < 1) or out; the current time keeps its position. */
export function zoom(factor: number): void {
  const { from, to } = range.peek();
  const time = timeS.peek();
  showRange(time - (time - from) * factor, time + (to - time) * factor);
}

/** Show the next part if the time leaves the visible one. */
function follow(): void {
  const { from, to } = range.peek();
  const time = timeS.peek();
  if (time > to) showRange(time - 0.1 * (to - from), time + 0.9 * (to - from));
  else if (time < from) showRange(time - 0.9 * (to - from), time + 0.1 * (to - from));
}

function play(now: number): void {
  if (!isPlaying.peek()) return;
  const passed = Math.max(0, now - playedAt) / 1000;
  playedAt = now;
  seek(timeS.peek() + passed * speed.peek());
  if (timeS.peek() >= endS) isPlaying.value = false;
  else requestAnimationFrame(play);
}

// Keys, for any focused element except those that use the key.

const USES_ALL_KEYS = "select, dialog, input:not([type=range])";
/** A button focused by keyboard; after a click Space is a command again. */
const USES_SPACE = "button:focus-visible";

/** Handle a key; also registered in the document inside the 3D view. */
export function handleKey(event: KeyboardEvent): void {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const target = event.target as Element | null;
  if (target?.closest?.(USES_ALL_KEYS)) return;
  if (event.key === " " && target?.matches?.(USES_SPACE)) return;
  const action = actions[event.key];
  if (action === undefined) return;
  event.preventDefault();
  event.stopPropagation();
  action(event.shiftKey);
}

const actions: Record<string, (isShifted: boolean) => void> = {
  " ": togglePlay,
  ArrowLeft: (isShifted) => go(-1, isShifted),
  ArrowRight: (isShifted) => go(1, isShifted),
  Home: () => seek(0),
  End: () => seek(Number.MAX_VALUE),
};

function go(direction: number, isShifted: boolean): void {
  if (isShifted) {
    isPlaying.value = false;
    seek(timeS.peek() + direction);
  } else stepFrames(direction);
}
