"""A student's submission: answers, ids of runs, and a law's file with the result of its trial."""

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Number, quantity
from svsa.inputs.explanation import explain_problems

LONGEST_NAME = 100
LONGEST_ANSWER = 2000
MAX_STEPS = 100
StepName = Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9-]{0,39}$")]
Words = Annotated[str, Field(max_length=LONGEST_ANSWER)]
Answer = Number | Words


class Submission(Checked):
    """A submission of one exercise, by its steps.

    answers: numbers that were predicted, in the unit that the step asks for, and names of options
    that were chosen. runs: the recorded run of each experiment. law_file: path of a Python file,
    beside the submission where it is relative.
    """

    student: str = quantity("", "Who submits it", min_length=1, max_length=LONGEST_NAME)
    exercise: StepName = quantity("", "Name of the exercise")
    answers: dict[StepName, Answer] = quantity(
        "", "What was predicted or chosen, by step", default={}, max_length=MAX_STEPS
    )
    runs: dict[StepName, str] = quantity(
        "", "Ids of recorded runs, by step", default={}, max_length=MAX_STEPS
    )
    law_file: str | None = quantity("", "Python file of a law", default=None, max_length=1000)


def read_submission(path: Path | str) -> Submission:
    """The submission of a JSON file; raises `ParameterError` with the file's name."""
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        bound = f"a readable JSON file ({error})"
        raise ParameterError(Violation("submit", path, "", bound)) from None
    try:
        return parse_submission(text)
    except ParameterError as error:
        raise ParameterError(*error.violations, file=str(path)) from None


def parse_submission(text: str) -> Submission:
    """The submission of a JSON text; raises `ParameterError`."""
    from pydantic import ValidationError

    try:
        return Submission.model_validate_json(text)
    except ValidationError as error:
        problems = error.errors(include_url=False)
        raise ParameterError(*explain_problems(problems, Submission.model_fields)) from None


def write_submission(path: Path | str, submission: Submission) -> None:
    """Write a submission as JSON, as `read_submission` reads it."""
    Path(path).write_text(submission.model_dump_json(indent=2) + "\n", encoding="utf-8")


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
