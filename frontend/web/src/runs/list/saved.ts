/** Outcome of the last recording: saved under a name, or the reason of the failure. */
import { effect, signal } from "@preact/signals";
import { readRun } from "../../core/api/runs";
import type { RunDetails } from "../../core/api/types";
import { session } from "../../core/state/session";

export type SaveStatus =
  | { stage: "saving"; run: string }
  | { stage: "saved"; run: string; details: RunDetails }
  | { stage: "unknown"; run: string };

export const saveStatus = signal<SaveStatus | null>(null);

const POLL_INTERVAL_MS = 400;
const TIMEOUT_MS = 60_000;
/** How long the message about a completely saved run is shown: the run stays in the list. */
const SHOWN_MS = 20_000;

const wait = (ms: number): Promise<void> => new Promise((done) => setTimeout(done, ms));

/** Poll until the file is finished; without an answer the state is unknown. */
export async function followSaving(run: string, timeoutMs = TIMEOUT_MS): Promise<void> {
  saveStatus.value = { stage: "saving", run };
  const isCurrent = () => saveStatus.peek()?.run === run;
  for (let waited = 0; waited < timeoutMs && isCurrent(); waited += POLL_INTERVAL_MS) {
    const details = await readRun(run).catch(() => null);
    if (!isCurrent()) return;
    if (details !== null && details.state !== "recording") {
      const shown: SaveStatus = { stage: "saved", run, details };
      saveStatus.value = shown;
      if (details.state === "complete") {
        setTimeout(() => {
          if (saveStatus.peek() === shown) saveStatus.value = null;
        }, SHOWN_MS);
      }
      return;
    }
    await wait(POLL_INTERVAL_MS);
  }
  if (isCurrent()) saveStatus.value = { stage: "unknown", run };
}

/** Save a recording that has ended, for any reason. */
export function watchRecording(): void {
  let recordingRun: string | null = null;
  effect(() => {
    const state = session.value;
    if (state === null) return;
    const now = state.recording?.run_id ?? null;
    if (now === recordingRun) return;
    const ended = recordingRun;
    recordingRun = now;
    if (now !== null) saveStatus.value = null;
    if (ended !== null) void followSaving(ended);
  });
}
