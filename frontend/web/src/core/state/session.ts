/** State of the session: signals for slow changes, a ring for the samples. */
import { computed, signal } from "@preact/signals";
import { readHealth, readState, streamAddress } from "../api/client";
import { LockedError, RefusedError } from "../api/errors";
import type { Hello, SessionState } from "../api/types";
import { type Phase, type ProbeResult, StreamConnection } from "../stream/connection";
import { BatchDecoder } from "../stream/decoder";
import { HISTORY_S, MAX_WINDOW_S, RATE_HZ, SampleRing } from "../stream/ring";

/** After a change the whole state; otherwise only the fields that change with time. */
export type Progress = Pick<SessionState, "run_number" | "tick"> & Partial<SessionState>;

const MAX_EVENTS = 200;

type Ended = { end_tick: number | null };

/**
 * Apply a message, which contains events, ended windows and ended segments of lanes from its
 * `sinceTick` on; earlier ones stay.
 */
export function mergeProgress(
  known: SessionState,
  progress: Progress,
  sinceTick: number,
): SessionState {
  const merged = { ...known, ...progress };
  if (sinceTick === 0) return merged;
  const firstTick = merged.tick - MAX_WINDOW_S * merged.rate_hz;
  const isBefore = ({ end_tick }: Ended) =>
    end_tick !== null && end_tick < sinceTick && end_tick > firstTick;
  if (progress.events !== undefined) {
    const before = known.events.filter(({ tick }) => tick < sinceTick);
    merged.events = [...before, ...progress.events].slice(-MAX_EVENTS);
  }
  if (progress.ended_windows !== undefined) {
    merged.ended_windows = [...known.ended_windows.filter(isBefore), ...progress.ended_windows];
  }
  if (progress.lanes !== undefined) {
    const pastOf = (lane: number) => known.lanes.find(({ id }) => id === lane)?.segments ?? [];
    merged.lanes = progress.lanes.map((lane) => ({
      ...lane,
      segments: [...pastOf(lane.id).filter(isBefore), ...lane.segments],
    }));
  }
  return merged;
}

const CAPACITY = MAX_WINDOW_S * RATE_HZ + 1;

type TextMessage = Hello | { type: "state"; since_tick: number; state: Progress };

export const session = signal<SessionState | null>(null);
export const phase = signal<Phase>("connecting");
export const missedSamples = signal(0);
/**
 * Number of connections whose first samples have arrived: used as key by parts that must restart
 * after a lost connection.
 */
export const connectionCount = signal(0);
/**
 * Set if a new session has the name of the one shown before, until the user dismisses the message.
 */
export const isNewInstance = signal(false);
/** Number of messages received: a plot with a smaller number has something to draw. */
export const receivedCount = signal(0);

/** Incremented when the samples are replaced. */
export function incrementReceived(): void {
  receivedCount.value = receivedCount.peek() + 1;
}

const LIVE: readonly Phase[] = ["live", "slow", "busy"];
export const isLive = computed(() => LIVE.includes(phase.value));
export const isLost = computed(() => phase.value === "lost" || phase.value === "blocked");
export const samples: { ring: SampleRing } = { ring: new SampleRing(1, []) };

let periodS = 0.001;
let decoder: BatchDecoder | null = null;
let currentRun = -1;
/** End of the newest samples of this connection and run; a batch before it belongs to the past. */
let endTick = 0;
/** Whether a connection has begun, and whether its first samples have not arrived yet. */
const beginning = { isNew: false, awaitsSamples: false };

/** The channels that the page requests, and whether the answer extends the stored samples. */
const selection: { channels: readonly string[]; extendsSamples: boolean } = {
  channels: [],
  extendsSamples: false,
};
const SELECTION_MS = 250;
let selectionTimer: ReturnType<typeof setTimeout> | undefined;
/** Incremented when a part of the past of newly selected channels has arrived. */
export const selectionCount = signal(0);

/** Number of commands of the run, the last part of a revision; progress has no revision. */
const countCommands = ({ revision }: Progress): number =>
  revision === undefined ? Number.POSITIVE_INFINITY : Number(revision.split(".").at(-1));

/** Two states of a paused session have the same tick: the answer to a request may come late. */
const isOlder = (state: Progress, known: SessionState): boolean =>
  state.tick < known.tick || countCommands(state) < countCommands(known);

/**
 * Apply the server's message, unless a newer one is known. sinceTick: start of the reported past;
 * all of it if left out.
 */
export function acceptState(state: Progress, sinceTick = 0): void {
  const known = session.peek();
  if (known === null || state.run_number < known.run_number) return;
  if (state.run_number === known.run_number && isOlder(state, known)) return;
  applyState(mergeProgress(known, state, sinceTick));
}

/** A restarted run has no samples yet: stored ones belong to the previous run. */
function beginRun(number: number): void {
  currentRun = number;
  endTick = 0;
  samples.ring.clear();
  incrementReceived();
}

/** The samples are in the order of the page's lanes. */
function applyState(state: SessionState): void {
  if (state.run_number > currentRun) beginRun(state.run_number);
  samples.ring.setLanes(state.lanes.map(({ id }) => id));
  session.value = state;
}

function acceptText(message: string): void {
  const content = JSON.parse(message) as TextMessage;
  beginning.awaitsSamples = content.type === "hello" && content.state.tick > 0;
  if (content.type === "state") {
    acceptState(content.state, content.since_tick);
    return;
  }
  if (content.type !== "hello") return;
  const names = content.channels.map((channel) => channel.name);
  const known = session.peek();
  const isSame = known === null || known.instance === content.state.instance;
  if (!isSame) isNewInstance.value = true;
  const extendsSamples =
    selection.extendsSamples && isSame && content.state.run_number === currentRun;
  periodS = content.period_s;
  decoder = new BatchDecoder(content);
  currentRun = content.state.run_number;
  endTick = 0;
  samples.ring = extendsSamples
    ? samples.ring.withChannels(names)
    : new SampleRing(CAPACITY, names);
  applyState(content.state);
  incrementReceived();
  if (extendsSamples) return;
  selection.extendsSamples = false;
  missedSamples.value = 0;
  beginning.isNew = true;
}

const PAST_NOTICE_MS = 300;
let isPastNoticed = false;

function noticePast(): void {
  isPastNoticed = false;
  selectionCount.value++;
}

function acceptBinary(message: ArrayBuffer): void {
  const batch = decoder?.decode(message);
  beginning.awaitsSamples = false;
  if (batch === undefined || batch.run < currentRun) return;
  if (batch.run > currentRun) beginRun(batch.run);
  if (batch.firstTick < endTick) {
    samples.ring.insert(batch, periodS);
    if (!isPastNoticed) setTimeout(noticePast, PAST_NOTICE_MS);
    isPastNoticed = true;
  } else {
    samples.ring.append(batch, periodS);
    endTick = batch.firstTick + (batch.count - 1) * batch.stride + 1;
  }
  if (batch.missed > 0) missedSamples.value += batch.missed;
  incrementReceived();
  if (selection.extendsSamples) {
    selection.extendsSamples = false;
    selectionCount.value++;
  }
}

function changePhase(next: Phase): void {
  if (next === "lost" || next === "blocked") selection.extendsSamples = false;
  if (next === "live") {
    // The greeting alone does not show that samples arrive.
    if (beginning.awaitsSamples) return;
    if (beginning.isNew) connectionCount.value++;
    beginning.isNew = false;
  }
  phase.value = next;
}

const SILENT_S = 1;

/** The server answers this request even if a session blocks all others. */
const areSessionsSilent = async (): Promise<boolean> => {
  const health = await readHealth().catch(() => null);
  return health !== null && health.sessions_silent_s > SILENT_S;
};

async function probe(): Promise<ProbeResult> {
  try {
    await readState();
    return "up";
  } catch (error) {
    if (error instanceof LockedError) return "locked";
    if (error instanceof RefusedError && error.status === 404) return "ended";
    return (await areSessionsSilent()) ? "blocked" : "down";
  }
}

const connection = new StreamConnection(
  () => streamAddress(RATE_HZ, HISTORY_S, selection.channels),
  probe,
  areSessionsSilent,
  {
    onPhase: changePhase,
    onText: acceptText,
    onBinary: acceptBinary,
  },
);

/** The dead-man's switch of a bench is held; the server accepts it for 0.1 s. */
export const sendSwitchHeld = (): void => connection.send("held");

export const openStream = (): void => connection.open();

const MAX_WAIT_MS = 10_000;

/**
 * Resolves when samples have arrived, or it is known that none will; after 10 s in any case. What
 * the first view can do without is loaded then, because it would delay the samples on a slow link.
 */
export const whenReceiving = (): Promise<void> =>
  new Promise((resolve) => {
    setTimeout(resolve, MAX_WAIT_MS);
    phase.subscribe((now) => {
      if (now !== "connecting") resolve();
    });
  });

/** Request these channels; their stored samples stay, and the last 20 s of new ones arrive. */
export function selectChannels(channels: readonly string[]): void {
  selection.channels = channels;
  clearTimeout(selectionTimer);
  const isSame = (names: readonly string[]) => names.join() === channels.join();
  selectionTimer = setTimeout(() => {
    if (!isLive.peek() || isSame(samples.ring.channels)) return;
    selection.extendsSamples = true;
    connection.open();
  }, SELECTION_MS);
}

export function watchNetwork(): void {
  const reconnect = () => {
    if (phase.peek() !== "locked" && phase.peek() !== "ended") connection.retryNow();
  };
  window.addEventListener("online", reconnect);
  document.addEventListener("visibilitychange", () => {
    if (!document.hidden) reconnect();
  });
}
