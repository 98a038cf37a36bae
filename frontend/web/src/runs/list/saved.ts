/** Outcome of the recording that ended last: saved under a name, or why not. */
import { effect, signal } from "@preact/signals";
import { readRun } from "../../core/api/runs";
import type { RunDetails } from "../../core/api/types";
import { session } from "../../core/state/session";

export type Saved =
  | { stage: "saving"; run: string }
  | { stage: "saved"; run: string; details: RunDetails }
  | { stage: "unknown"; run: string };

export const saved = signal<Saved | null>(null);

const ASK_MS = 400;
const PATIENCE_MS = 60_000;
/** How long the message about a completely saved run is shown: the run stays in the list. */
const SHOWN_MS = 20_000;

const wait = (ms: number): Promise<void> => new Promise((done) => setTimeout(done, ms));

/** Asks until the file is finished; an answer that does not come is an unknown state. */
export async function followSaved(run: string, patienceMs = PATIENCE_MS): Promise<void> {
  saved.value = { stage: "saving", run };
  const isStill = () => saved.peek()?.run === run;
  for (let waited = 0; waited < patienceMs && isStill(); waited += ASK_MS) {
    const details = await readRun(run).catch(() => null);
    if (!isStill()) return;
    if (details !== null && details.state !== "recording") {
      const shown: Saved = { stage: "saved", run, details };
      saved.value = shown;
      if (details.state === "complete") {
        setTimeout(() => {
          if (saved.peek() === shown) saved.value = null;
        }, SHOWN_MS);
      }
      return;
    }
    await wait(ASK_MS);
  }
  if (isStill()) saved.value = { stage: "unknown", run };
}

/** A recording that has ended, for any reason, is saved. */
export function watchRecording(): void {
  let recorded: string | null = null;
  effect(() => {
    const state = session.value;
    if (state === null) return;
    const now = state.recording?.run_id ?? null;
    if (now === recorded) return;
    const ended = recorded;
    recorded = now;
    if (now !== null) saved.value = null;
    if (ended !== null) void followSaved(ended);
  });
}
