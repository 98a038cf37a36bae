/** The emergency stop: sent at once, asked again until the server confirms it. */
import { signal } from "@preact/signals";
import { stopAtOnce } from "../api/client";
import { RefusedError } from "../api/errors";
import type { SessionState } from "../api/types";
import { acceptState } from "../state/session";

export type StopStage = "idle" | "sending" | "confirmed" | "unconfirmed" | "refused";

/** How far the last stop of this page is, and why it was refused. */
export const stop = signal<{ stage: StopStage; message: string }>({ stage: "idle", message: "" });

const RETRY_MS = 300;
const CONFIRMED_MS = 3000;
const ATTEMPTS = 60;

const wait = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));
const isFinal = (error: unknown): error is RefusedError =>
  error instanceof RefusedError && error.status < 500;

let latest = 0;

/** Sends the stop; another press sends another one, which takes the place of this one. */
export async function pressStop(): Promise<void> {
  const mine = ++latest;
  const tell = (stage: StopStage, message = "") => {
    if (mine === latest) stop.value = { stage, message };
  };
  tell("sending");
  for (let attempt = 0; attempt < ATTEMPTS && mine === latest; attempt++) {
    try {
      confirm(await stopAtOnce(), tell);
      await wait(CONFIRMED_MS);
      return tell("idle");
    } catch (error) {
      if (isFinal(error)) return tell("refused", error.message);
      tell("unconfirmed");
      await wait(RETRY_MS);
    }
  }
}

function confirm(state: SessionState, tell: (stage: StopStage) => void): void {
  acceptState(state);
  tell("confirmed");
}
