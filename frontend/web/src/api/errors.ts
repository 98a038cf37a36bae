/** The server answered, and refused: `message` is written for the user. */
export class RefusedError extends Error {
  constructor(
    readonly status: number,
    message: string,
  ) {
    super(message);
    this.name = "RefusedError";
  }
}

/** The server asks for the shared secret (HTTP 401). */
export class LockedError extends RefusedError {
  constructor(message: string) {
    super(401, message);
    this.name = "LockedError";
  }
}

/** The server could not be reached. */
export class UnreachableError extends Error {
  constructor(cause: unknown) {
    super("unreachable", { cause });
    this.name = "UnreachableError";
  }
}
