/** Every wish of the user goes through `perform`: it sends, takes over the answer, keeps the refusal. */
import { type Signal, signal } from "@preact/signals";
import { expectRevision, lastSet, readState } from "../api/client";
import {
  ChangedError,
  LockedError,
  NotCarriedOutError,
  RefusedError,
  UnansweredError,
} from "../api/errors";
import type { SessionState } from "../api/types";
import { text } from "../text/en";
import { describeChange, isSame } from "./meanwhile";
import { explainRefusal } from "./refusal";
import { acceptState, phase, session } from "./session";

const MAX_TRIES = 5;

interface Refused {
  control: string;
  message: string;
  /** Sends it all the same, where only another person's change stood against it. */
  again?: () => Promise<boolean>;
}

/** The last refusal and the control that caused it; the next action takes its place. */
export const problem = signal<Refused | null>(null);

/** Why a wish was not fulfilled, as the user reads it. */
export function explain(error: unknown): string {
  if (error instanceof RefusedError) return explainRefusal(error);
  if (error instanceof NotCarriedOutError) {
    return error.status === null
      ? text.connection.notCarriedOut
      : text.connection.refused(error.status);
  }
  const isUnknown = error instanceof UnansweredError && error.request !== null;
  return isUnknown ? text.connection.stillUnknown : text.connection.unreachable;
}

/** As `explain`, but a refusal in the server's words, which name file, line, value and bound. */
export const describeError = (error: unknown): string =>
  error instanceof RefusedError ? error.message : explain(error);

/**
 * Sends for as long as only other things than this one were changed since `seen`; throws the
 * `ChangedError` if another client has set the same value.
 */
async function sendUnlessChanged(
  request: () => Promise<SessionState>,
  seen: SessionState | null,
): Promise<SessionState> {
  let known = seen;
  for (let left = MAX_TRIES; ; left--) {
    expectRevision(known?.revision ?? null);
    try {
      return await request();
    } catch (error) {
      if (!(error instanceof ChangedError)) throw error;
      const now = await readState();
      acceptState(now);
      const isOthers = [seen, lastSet(error.path)].every((held) => !isSame(error.path, held, now));
      if (isOthers || left === 0) throw error;
      known = now;
    }
  }
}

/**
 * Sends a request for a control; resolves when the page shows what the server holds. seen: what
 * the user saw who asks for it, if that was not now.
 */
export async function perform(
  control: string,
  request: () => Promise<SessionState>,
  seen: SessionState | null = session.peek(),
): Promise<boolean> {
  problem.value = null;
  try {
    acceptState(await sendUnlessChanged(request, seen));
    return true;
  } catch (error) {
    if (error instanceof LockedError) phase.value = "locked";
    problem.value =
      error instanceof ChangedError
        ? {
            control,
            message: describeChange(error.path, seen, session.peek()),
            again: () => perform(control, request),
          }
        : { control, message: explain(error) };
    return false;
  }
}

// A request whose rejection is shown at a place of the page.

type Attempt = <T>(wish: () => Promise<T>) => Promise<T | null>;

/** Wraps a background request: null if rejected; an earlier error message stays. */
export const asking =
  (problem: Signal<string>): Attempt =>
  async (wish) => {
    try {
      return await wish();
    } catch (error) {
      problem.value = describeError(error);
      return null;
    }
  };

/** Shows why a repeated request has no answer; null: it has one after all. */
export const showErrorIn = (problem: Signal<string>) => (error: unknown) => {
  problem.value =
    error === null
      ? ""
      : error instanceof UnansweredError
        ? text.connection.retrying
        : describeError(error);
};

/** Wraps a request of the user: null if rejected, with its reason shown. */
export const attempting = (problem: Signal<string>): Attempt => {
  const ask = asking(problem);
  return (wish) => {
    problem.value = "";
    return ask(wish);
  };
};
