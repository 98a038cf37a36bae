/** What the page knows of the session: signals for what changes slowly, a ring for the samples. */
import { computed, signal } from "@preact/signals";
import { readState, streamAddress } from "../api/client";
import { LockedError, RefusedError } from "../api/errors";
import type { Hello, SessionState } from "../api/types";
import { type Finding, type Phase, StreamConnection } from "../stream/connection";
import { BatchDecoder } from "../stream/decoder";
import { HISTORY_S, LONGEST_WINDOW_S, RATE_HZ, SampleRing } from "../stream/ring";
import { type Mark, markOfBench } from "./plant";

/** After a change the whole state; between changes only the fields that change with time. */
export type Progress = Pick<SessionState, "run_number" | "tick"> & Partial<SessionState>;

const MAX_EVENTS = 200;

type Over = { end_tick: number | null };

/**
 * The state after a message, which reports events, ended windows and ended segments of lanes from
 * its `sinceTick` on: those before are as they were known.
 */
export function joinPast(known: SessionState, progress: Progress, sinceTick: number): SessionState {
  const joined = { ...known, ...progress };
  if (sinceTick === 0) return joined;
  const firstTick = joined.tick - LONGEST_WINDOW_S * joined.rate_hz;
  const isBefore = ({ end_tick }: Over) =>
    end_tick !== null && end_tick < sinceTick && end_tick > firstTick;
  if (progress.events !== undefined) {
    const before = known.events.filter(({ tick }) => tick < sinceTick);
    joined.events = [...before, ...progress.events].slice(-MAX_EVENTS);
  }
  if (progress.ended_windows !== undefined) {
    joined.ended_windows = [...known.ended_windows.filter(isBefore), ...progress.ended_windows];
  }
  if (progress.lanes !== undefined) {
    const pastOf = (lane: number) => known.lanes.find(({ id }) => id === lane)?.segments ?? [];
    joined.lanes = progress.lanes.map((lane) => ({
      ...lane,
      segments: [...pastOf(lane.id).filter(isBefore), ...lane.segments],
    }));
  }
  return joined;
}

const CAPACITY = LONGEST_WINDOW_S * RATE_HZ + 1;

type TextMessage = Hello | { type: "state"; since_tick: number; state: Progress };

export const session = signal<SessionState | null>(null);
export const phase = signal<Phase>("connecting");
export const missedSamples = signal(0);
/** Counts the connections: what must start afresh after a lost one is keyed by it. */
export const connectionCount = signal(0);
/** A new session has the name of the one that was shown, until the user dismisses the message. */
export const isAnother = signal(false);
/** Counts what was received: a plot whose count is behind has something to draw. */
export const received = signal(0);

/** Other samples are there than before. */
export function countReceived(): void {
  received.value = received.peek() + 1;
}

export const isLive = computed(() => phase.value === "live");
export const samples: { ring: SampleRing } = { ring: new SampleRing(1, []) };

let periodS = 0.001;
let decoder: BatchDecoder | null = null;
let run = -1;

/** The channels that the page asks for, and whether the answer continues what it holds already. */
const selection: { channels: readonly string[]; continues: boolean } = {
  channels: [],
  continues: false,
};
const SELECTION_MS = 250;
let selectionTimer: ReturnType<typeof setTimeout> | undefined;
/** Counts the selections of channels whose past has come. */
export const selectionCount = signal(0);

/**
 * Takes over what the server sent, unless something newer is known. sinceTick: from where on it
 * tells what is over; all of it, if left out.
 */
export function acceptState(state: Progress, sinceTick = 0): void {
  const known = session.peek();
  if (known === null || state.run_number < known.run_number) return;
  if (state.run_number === known.run_number && state.tick < known.tick) return;
  take(joinPast(known, state, sinceTick));
}

/** A run that has begun has no samples yet: those of the one before are not of it. */
function beginRun(number: number): void {
  run = number;
  samples.ring.clear();
  countReceived();
}

/** The samples stand in the order of the lanes that the page draws them as. */
function take(state: SessionState): void {
  if (state.run_number > run) beginRun(state.run_number);
  samples.ring.arrange(state.lanes.map(({ id }) => id));
  session.value = state;
}

function acceptText(message: string): void {
  const content = JSON.parse(message) as TextMessage;
  if (content.type === "state") {
    acceptState(content.state, content.since_tick);
    return;
  }
  if (content.type !== "hello") return;
  const names = content.channels.map((channel) => channel.name);
  const known = session.peek();
  const isSame = known === null || known.instance === content.state.instance;
  if (!isSame) isAnother.value = true;
  const continues = selection.continues && isSame && content.state.run_number === run;
  periodS = content.period_s;
  decoder = new BatchDecoder(content);
  run = content.state.run_number;
  samples.ring = continues ? samples.ring.reselect(names) : new SampleRing(CAPACITY, names);
  take(content.state);
  countReceived();
  if (continues) return;
  selection.continues = false;
  missedSamples.value = 0;
  connectionCount.value++;
}

function acceptBinary(message: ArrayBuffer): void {
  const batch = decoder?.decode(message);
  if (batch === undefined || batch.run < run) return;
  if (batch.run > run) beginRun(batch.run);
  samples.ring.append(batch, periodS);
  if (batch.missed > 0) missedSamples.value += batch.missed;
  countReceived();
  if (selection.continues) {
    selection.continues = false;
    selectionCount.value++;
  }
}

async function probe(): Promise<Finding> {
  try {
    await readState();
    return "up";
  } catch (error) {
    if (error instanceof LockedError) return "locked";
    return error instanceof RefusedError && error.status === 404 ? "ended" : "down";
  }
}

const connection = new StreamConnection(
  () => streamAddress(RATE_HZ, HISTORY_S, selection.channels),
  probe,
  {
    onPhase: (next) => {
      phase.value = next;
      if (next === "lost") selection.continues = false;
    },
    onText: acceptText,
    onBinary: acceptBinary,
  },
);

/** The dead-man's switch of a bench is held; the server takes it for 0.1 s. */
export const saySwitchIsHeld = (): void => connection.say("held");

export const openStream = (): void => connection.open();

/** Has the stream carry these channels; what is held of them stays, the last 20 s of new ones come. */
export function selectChannels(channels: readonly string[]): void {
  selection.channels = channels;
  clearTimeout(selectionTimer);
  const isSame = (names: readonly string[]) => names.join() === channels.join();
  selectionTimer = setTimeout(() => {
    if (phase.peek() !== "live" || isSame(samples.ring.channels)) return;
    selection.continues = true;
    connection.open();
  }, SELECTION_MS);
}

export function watchNetwork(): void {
  const hurry = () => {
    if (phase.peek() !== "locked" && phase.peek() !== "ended") connection.hurry();
  };
  window.addEventListener("online", hurry);
  document.addEventListener("visibilitychange", () => {
    if (!document.hidden) hurry();
  });
}

export const bench = computed(() => session.value?.bench ?? null);

/** Null for a simulation, which needs no mark. */
export const mark = computed<Mark | null>(() => {
  if (bench.value === null) return null;
  return markOfBench(bench.value);
});
