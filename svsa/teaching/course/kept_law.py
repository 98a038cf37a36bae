"""A law that is kept until it is submitted, and what came of trying it."""

from typing import Annotated, Literal

from pydantic import Field

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, quantity

MAX_LAW_BYTES = 1 << 16
LONGEST_OUTPUT = 2000

TrialVerdict = Literal["held", "ran", "ended", "failed", "untried"]
"""At most 1° rms at the end; to the end, but further off; the run ended; the law failed at its own
part; this machine could not try it."""


class KeptLaw(Checked):
    """A law's file, and the verdict of its trial. output: the end of what it printed."""

    text: str = quantity("", "Text of a law's Python file")
    verdict: TrialVerdict = quantity("", "What came of trying it")
    feedback: str = quantity("", "The same in words")
    output: Annotated[str, Field(max_length=LONGEST_OUTPUT)] = quantity(
        "", "End of what it printed, where it failed", default=""
    )


def check_law_length(text: bytes) -> None:
    """Raise `ParameterError` for a text that is longer than `MAX_LAW_BYTES`."""
    if len(text) > MAX_LAW_BYTES:
        bound = f"a text of at most {MAX_LAW_BYTES} bytes"
        raise ParameterError(Violation("law", f"{len(text)} bytes", "", bound))
