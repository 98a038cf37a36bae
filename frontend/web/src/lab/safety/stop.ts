/** The quick stop: sent at once, and repeated until the server confirms it. */
import { signal } from "@preact/signals";
import { quickStop, quickStopWithoutLogin } from "../../core/api/client";
import { LockedError, RefusedError } from "../../core/api/errors";
import { acceptState } from "../../core/state/session";

export type StopStage = "idle" | "sending" | "confirmed" | "unconfirmed" | "refused";

/** Status of this page's last stop, and the reason of a rejection. */
export const stopState = signal<{ stage: StopStage; message: string }>({
  stage: "idle",
  message: "",
});

const RETRY_MS = 300;
const CONFIRMED_MS = 3000;
const ATTEMPTS = 60;

const wait = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));
const isFinal = (error: unknown): error is RefusedError =>
  error instanceof RefusedError && error.status < 500;

let latestNumber = 0;

/** Send the stop; another press sends a new one, which replaces this one. */
export async function pressStop(): Promise<void> {
  const attemptNumber = ++latestNumber;
  const report = (stage: StopStage, message = "") => {
    if (attemptNumber === latestNumber) stopState.value = { stage, message };
  };
  report("sending");
  for (let attempt = 0; attempt < ATTEMPTS && attemptNumber === latestNumber; attempt++) {
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
    acceptState(await quickStop());
  } catch (error) {
    if (!(error instanceof LockedError)) throw error;
    await quickStopWithoutLogin();
  }
}
