"""A submission: answers, ids of runs and a law's file, with SHA-256 digests."""

import hashlib
from pathlib import Path
from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Number, quantity
from svsa.inputs.explanation import explain_problems

LONGEST_NAME = 100
LONGEST_ANSWER = 2000
LONGEST_OUTPUT = 2000
MAX_STEPS = 100
MAX_LAW_BYTES = 1 << 16
StepName = Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9-]{0,39}$")]
Words = Annotated[str, Field(max_length=LONGEST_ANSWER)]
Answer = Number | Words


def _check_law(text: str) -> str:
    if len(text.encode()) > MAX_LAW_BYTES:
        raise ValueError(f"a text of at most {MAX_LAW_BYTES} bytes")
    return text


LawText = Annotated[str, Field(min_length=1, max_length=MAX_LAW_BYTES), AfterValidator(_check_law)]
"""Text of a law's Python file, as it is sent to the lab."""


class Submission(Checked):
    """The submission of one exercise, by its steps.

    Attributes:
        answers: Predicted numbers, in the unit of the step, and names of chosen options.
        runs: Recorded run of each experiment.
        law_file: Path of a Python file, in the folder of the submission.
        law: Text of that file.
    """

    student: str = quantity("", "Name of the student", min_length=1, max_length=LONGEST_NAME)
    exercise: StepName = quantity("", "Name of the exercise")
    answers: dict[StepName, Answer] = quantity(
        "", "Predictions and choices, by step", default={}, max_length=MAX_STEPS
    )
    runs: dict[StepName, str] = quantity(
        "", "Ids of recorded runs, by step", default={}, max_length=MAX_STEPS
    )
    law_file: str | None = quantity("", "Python file of a law", default=None, max_length=1000)
    law: bytes | None = quantity("", "Text of that file", default=None, exclude=True)

    @property
    def digest(self) -> str:
        """SHA-256 of the complete submission, in hexadecimal."""
        content = self.model_dump_json(exclude={"law_file"}).encode()
        law = b"" if self.law is None else hashlib.sha256(self.law).digest()
        return hashlib.sha256(hashlib.sha256(content).digest() + law).hexdigest()

    def write(self, path: Path) -> None:
        """Write the submission as JSON, and its law next to it, for `read_submission`."""
        written = self
        if self.law is not None:
            law = path.with_suffix(".py")
            law.write_bytes(self.law)
            written = self.changed(law_file=law.name)
        path.write_text(written.model_dump_json(indent=2) + "\n", encoding="utf-8")


def digest_law(law: bytes | None) -> str:
    """Compute SHA-256 of a law's text, in hexadecimal; without a law, of an empty text."""
    return hashlib.sha256(law or b"").hexdigest()


def read_submission(path: Path | str) -> Submission:
    """Read a submission from JSON, with its law.

    Raises:
        ParameterError: If a file is invalid, with its name.
    """
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        bound = f"a readable JSON file ({error})"
        raise ParameterError(Violation("submit", path, "", bound)) from None
    try:
        submission = _parse(text)
        if submission.law is not None:
            bound = "omitted: law_file names its file"
            raise ParameterError(Violation("law", None, "", bound))
        file = submission.law_file
        return submission.changed(law=None if file is None else _read_law_in(path.parent, file))
    except ParameterError as error:
        raise ParameterError(*error.violations, file=str(path)) from None


def _parse(text: str) -> Submission:
    from pydantic import ValidationError

    try:
        return Submission.model_validate_json(text)
    except ValidationError as error:
        problems = error.errors(include_url=False)
        raise ParameterError(*explain_problems(problems, Submission.model_fields)) from None


def _read_law_in(folder: Path, name: str) -> bytes:
    """Read a law's file within a folder.

    Raises:
        ParameterError: If it cannot be read or is outside the folder.
    """
    path = (folder / name).resolve()
    if not path.is_relative_to(folder.resolve()):
        raise ParameterError(Violation("law_file", name, "", "a file next to the submission"))
    return read_law(path)


def read_law(path: Path) -> bytes:
    """Read a law's file.

    Raises:
        ParameterError: If it cannot be read.
    """
    try:
        with path.open("rb") as file:
            text = file.read(MAX_LAW_BYTES + 1)
    except OSError as error:
        bound = f"a file that can be read ({error.strerror})"
        raise ParameterError(Violation("law_file", path, "", bound)) from None
    if len(text) > MAX_LAW_BYTES:
        bound = f"a file of at most {MAX_LAW_BYTES} bytes"
        raise ParameterError(Violation("law_file", path, "", bound))
    return text


TrialVerdict = Literal["held", "ran", "ended", "failed", "untried"]
"""At most 1° rms at the end; completed, but with a larger error; the run ended early; the law
itself failed; this machine could not run it.
"""


class SavedLaw(Checked):
    """A law's file and the result of its trial; `output` is the end of its output."""

    text: str = quantity("", "Text of a law's Python file")
    verdict: TrialVerdict = quantity("", "Outcome of the trial run")
    feedback: str = quantity("", "Outcome as text")
    output: Annotated[str, Field(max_length=LONGEST_OUTPUT)] = quantity(
        "", "Last lines of its output if it failed", default=""
    )
