/** The quick stop: sent at once, asked again until the server confirms it. */
import { signal } from "@preact/signals";
import { stopAtOnce, stopWithoutLogin } from "../../core/api/client";
import { LockedError, RefusedError } from "../../core/api/errors";
import { acceptState } from "../../core/state/session";

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
  const report = (stage: StopStage, message = "") => {
    if (mine === latest) stop.value = { stage, message };
  };
  report("sending");
  for (let attempt = 0; attempt < ATTEMPTS && mine === latest; attempt++) {
    try {
      await send();
      report("confirmed");
      await wait(CONFIRMED_MS);
      return report("idle");
    } catch (error) {
      if (isFinal(error)) return report("refused", error.message);
      report("unconfirmed");
      await wait(RETRY_MS);
    }
  }
}

async function send(): Promise<void> {
  try {
    acceptState(await stopAtOnce());
  } catch (error) {
    if (!(error instanceof LockedError)) throw error;
    await stopWithoutLogin();
  }
}
