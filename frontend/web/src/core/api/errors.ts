import type { Refusal } from "./types";

export type Violation = Refusal["violations"][number];

/** The server rejected the request: `violations` lists every invalid value. */
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
    /** The setting: a path below the session, such as "/position". */
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

/** No answer came: the server may have executed the request nevertheless. */
export class UnansweredError extends Error {
  constructor(
    cause: unknown,
    /** Id of the request on the server; null for a request that changes nothing. */
    readonly request: string | null = null,
    /** Time of sending, `performance.now()`. */
    readonly sentMs = 0,
    /** Entry of the call in the page's log. */
    readonly call: number | null = null,
  ) {
    super("unanswered", { cause });
    this.name = "UnansweredError";
  }
}

/** The server reports that it has not executed the request. */
export class NotExecutedError extends Error {
  constructor(readonly status: number | null) {
    super("not carried out");
    this.name = "NotExecutedError";
  }
}
