import type { Refusal } from "./types";

export type Violation = Refusal["violations"][number];

/** The server answered, and refused: `violations` has each value that it did not take. */
export class RefusedError extends Error {
  constructor(
    readonly status: number,
    message: string,
    readonly violations: readonly Violation[] = [],
  ) {
    super(message);
    this.name = "RefusedError";
  }
}

/** Another client changed the session after its revision was read (HTTP 412); nothing was set. */
export class ChangedError extends RefusedError {
  constructor(
    message: string,
    /** What was to be set: a path below the session, such as "/position". */
    readonly path: string,
  ) {
    super(412, message);
    this.name = "ChangedError";
  }
}

/** The server asks for the shared secret (HTTP 401). */
export class LockedError extends RefusedError {
  constructor(message: string) {
    super(401, message);
    this.name = "LockedError";
  }
}

/** No answer came: the request may have been carried out all the same. */
export class UnansweredError extends Error {
  constructor(
    cause: unknown,
    /** Under which the server knows the request; null for one that changes nothing. */
    readonly request: string | null = null,
    /** When it was sent, `performance.now()`. */
    readonly sentMs = 0,
    /** The call as the page notes it. */
    readonly call: number | null = null,
  ) {
    super("unanswered", { cause });
    this.name = "UnansweredError";
  }
}

/** The server was asked again: it has not carried out the request. */
export class NotCarriedOutError extends Error {
  constructor(readonly status: number | null) {
    super("not carried out");
    this.name = "NotCarriedOutError";
  }
}
