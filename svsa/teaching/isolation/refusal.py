"""Errors of isolated laws."""

from typing import Literal, Self

from svsa.errors import SvsaError

LawFaultCode = Literal["error", "late", "early", "ended", "garbled"]
"""It raised an exception; it did not answer in time; it answered another request; it ended; its
output is no answer.
"""


PRINTED = "The law printed:"


class NotIsolatedError(SvsaError):
    """An untrusted law cannot be isolated on this machine; the message has the reason."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(
            f"A law cannot be isolated on this machine: {reason}. It takes Linux with user"
            " namespaces, bubblewrap (bwrap) and libseccomp."
        )


class LawFaultError(SvsaError):
    """A law that failed; `code` is the kind of failure, `output` the end of its output."""

    def __init__(self, code: LawFaultCode, message: str, output: str = "") -> None:
        self.code: LawFaultCode = code
        self.output = output
        super().__init__(message)

    def __reduce__(self) -> tuple[type[Self], tuple[LawFaultCode, str, str]]:
        """Return how another process rebuilds the error."""
        return type(self), (self.code, str(self), self.output)


def describe_output(output: str) -> str:
    """Format the last output of a failed law on separate lines; empty if there was none.

    Args:
        output: End of the output, with the traceback of an error.
    """
    shown = output.strip()
    return f"\n{PRINTED}\n{shown}" if shown else ""
