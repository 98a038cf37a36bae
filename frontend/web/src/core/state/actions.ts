/**
 * Every request of the user goes through `perform`: it sends it, applies the answer, and stores the
 * rejection.
 */
import { type Signal, signal } from "@preact/signals";
import { lastConfirmed, readState, type SessionRequest } from "../api/client";
import {
  ChangedError,
  LockedError,
  NotExecutedError,
  RefusedError,
  UnansweredError,
} from "../api/errors";
import { Edit } from "../api/operations";
import type { Joint, SessionState } from "../api/types";
import { t } from "../text/t";
import { chosenJoint } from "./arm";
import { describeChange, isSame } from "./conflicts";
import { explainRefusal } from "./refusal";
import { acceptState, phase, session } from "./session";

const MAX_TRIES = 5;

interface Rejection {
  control: string;
  message: string;
  error?: unknown;
  /** Send it again although another user's change caused the rejection. */
  retry?: () => Promise<boolean>;
}

/** The last rejection and the control that caused it; cleared by the next action. */
export const problem = signal<Rejection | null>(null);

/** The reason of a rejection in the words of the page. */
export function explain(error: unknown): string {
  if (error instanceof RefusedError) return explainRefusal(error);
  if (error instanceof RangeError) return error.message; // a text of the page, not sent
  if (error instanceof NotExecutedError) {
    return error.status === null
      ? t("connection.notCarriedOut")
      : t("connection.refused", { status: error.status });
  }
  const isUnknown = error instanceof UnansweredError && error.request !== null;
  return isUnknown ? t("connection.stillUnknown") : t("connection.unreachable");
}

/** As `explain`, but with the server's message, which names file, line, value and bound. */
export const describeError = (error: unknown): string =>
  error instanceof RefusedError ? error.message : explain(error);

/**
 * Send while only other settings have changed since `base`; throws the `ChangedError` if another
 * client has set the same value.
 */
async function sendUnlessChanged(
  request: SessionRequest,
  base: SessionState | null,
  joint: Joint | null,
): Promise<SessionState> {
  let known = base;
  for (let left = MAX_TRIES; ; left--) {
    try {
      return await request(new Edit(joint, { revision: known?.revision ?? null }));
    } catch (error) {
      if (!(error instanceof ChangedError)) throw error;
      const now = await readState();
      acceptState(now);
      const isConflict = [base, lastConfirmed(error.path)].every(
        (earlier) => !isSame(error.path, earlier, now),
      );
      if (isConflict || left === 0) throw error;
      known = now;
    }
  }
}

/** Send a request; resolves when the page shows the state of the server, throws its rejection. */
export async function execute(
  request: SessionRequest,
  base: SessionState | null = session.peek(),
  joint: Joint | null = chosenJoint.peek(),
): Promise<void> {
  try {
    acceptState(await sendUnlessChanged(request, base, joint));
  } catch (error) {
    if (error instanceof LockedError) phase.value = "locked";
    throw error;
  }
}

/**
 * Send a request for a control, which shows a rejection. base: the state that the user saw, if not
 * the current one. joint: that on which the request acts.
 */
export async function perform(
  control: string,
  request: SessionRequest,
  base: SessionState | null = session.peek(),
  joint: Joint | null = chosenJoint.peek(),
): Promise<boolean> {
  problem.value = null;
  try {
    await execute(request, base, joint);
    return true;
  } catch (error) {
    problem.value =
      error instanceof ChangedError
        ? {
            control,
            message: describeChange(error.path, base, session.peek()),
            retry: () => perform(control, request, undefined, joint),
          }
        : { control, message: explain(error), error };
    return false;
  }
}

/** Show why a repeated request has no answer; null clears the message. */
export const showErrorIn = (problem: Signal<string>) => (error: unknown) => {
  problem.value =
    error === null
      ? ""
      : error instanceof UnansweredError
        ? t("connection.retrying")
        : describeError(error);
};
