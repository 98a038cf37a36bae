/** What the page knows of the session: signals for what changes slowly, a ring for the samples. */
import { computed, signal } from "@preact/signals";
import { readState, streamAddress } from "../api/client";
import { LockedError } from "../api/errors";
import type { SessionState } from "../api/types";
import { type Finding, type Phase, StreamConnection } from "../stream/connection";
import { decodeBatch } from "../stream/decoder";
import { SampleRing } from "../stream/ring";

export const RATE_HZ = 200;
export const HISTORY_S = 20;
export const LONGEST_WINDOW_S = 60;
const CAPACITY = LONGEST_WINDOW_S * RATE_HZ + 1;

interface Hello {
  type: "hello";
  period_s: number;
  channels: { name: string; unit: string; label: string }[];
  state: SessionState;
}
/** After a change the whole state; once a second only the fields that move by themselves. */
type Progress = Pick<SessionState, "run" | "tick"> & Partial<SessionState>;
type TextMessage = Hello | { type: "state"; state: Progress };

export const session = signal<SessionState | null>(null);
export const phase = signal<Phase>("connecting");
export const missedSamples = signal(0);
/** Counts the connections: what must start afresh after a lost one is keyed by it. */
export const connectionCount = signal(0);
/** Counts what was received: a plot whose count is behind has something to draw. */
export const received = { count: 0 };

export const isLive = computed(() => phase.value === "live");
export const samples: { ring: SampleRing } = { ring: new SampleRing(1, []) };

let periodS = 0.001;
let run = -1;

/** Takes over what the server sent, unless something newer of the same run is known. */
export function acceptState(state: Progress): void {
  const known = session.peek();
  if (known === null || (known.run === state.run && state.tick < known.tick)) return;
  session.value = { ...known, ...state };
}

function acceptText(message: string): void {
  const content = JSON.parse(message) as TextMessage;
  if (content.type === "state") {
    acceptState(content.state);
    return;
  }
  if (content.type !== "hello") return;
  periodS = content.period_s;
  run = content.state.run;
  samples.ring = new SampleRing(
    CAPACITY,
    content.channels.map((channel) => channel.name),
  );
  session.value = content.state;
  missedSamples.value = 0;
  connectionCount.value++;
  received.count++;
}

function acceptBinary(message: ArrayBuffer): void {
  const batch = decodeBatch(message, samples.ring.channels.length);
  if (batch.run !== run) {
    run = batch.run;
    samples.ring.clear();
  }
  samples.ring.append(batch, periodS);
  if (batch.missed > 0) missedSamples.value += batch.missed;
  received.count++;
}

async function probe(): Promise<Finding> {
  try {
    await readState();
    return "up";
  } catch (error) {
    return error instanceof LockedError ? "locked" : "down";
  }
}

const connection = new StreamConnection(() => streamAddress(RATE_HZ, HISTORY_S), probe, {
  onPhase: (next) => {
    phase.value = next;
  },
  onText: acceptText,
  onBinary: acceptBinary,
});

export const openStream = (): void => connection.open();

export function watchNetwork(): void {
  window.addEventListener("online", () => connection.hurry());
  document.addEventListener("visibilitychange", () => {
    if (!document.hidden && phase.peek() !== "locked") connection.hurry();
  });
}
