"""A submission: a submission with its law's text, and one number for all of it."""

import hashlib
from pathlib import Path
from typing import NamedTuple, Self

from svsa.errors import ParameterError, Violation
from svsa.teaching.course.submission import MAX_LAW_BYTES, Submission, read_submission


class SubmittedWork(NamedTuple):
    """What was submitted. law: text of the law's file, None where none belongs to it."""

    submission: Submission
    law: bytes | None

    @classmethod
    def read(cls, path: Path) -> Self:
        """The submission of a submission's file; its law stands in the same folder.

        Raises `ParameterError`.
        """
        submission = read_submission(path)
        if submission.law_file is None:
            return cls(submission, None)
        try:
            return cls(submission, read_law(path.parent, submission.law_file))
        except ParameterError as error:
            raise ParameterError(*error.violations, file=str(path)) from None

    @property
    def digest(self) -> str:
        """SHA-256 of everything that was submitted, in hexadecimal."""
        reported = self.submission.model_dump_json(exclude={"law_file"}).encode()
        law = b"" if self.law is None else hashlib.sha256(self.law).digest()
        return hashlib.sha256(hashlib.sha256(reported).digest() + law).hexdigest()

    @property
    def law_digest(self) -> str:
        """SHA-256 of the law's text, in hexadecimal: of none, that of an empty one."""
        return hashlib.sha256(self.law or b"").hexdigest()


def read_law(folder: Path, name: str) -> bytes:
    """The text of a law's file in a folder, which it cannot leave; raises `ParameterError`."""
    path = (folder / name).resolve()
    if not path.is_relative_to(folder.resolve()):
        raise ParameterError(Violation("law_file", name, "", "a file beside the submission"))
    return read_law_file(path)


def read_law_file(path: Path) -> bytes:
    """The text of a law's file; raises `ParameterError`."""
    try:
        with path.open("rb") as file:
            text = file.read(MAX_LAW_BYTES + 1)
    except OSError as error:
        bound = f"a file that can be read ({error.strerror})"
        raise ParameterError(Violation("law_file", path, "", bound)) from None
    if len(text) > MAX_LAW_BYTES:
        raise ParameterError(
            Violation("law_file", path, "", f"a file of at most {MAX_LAW_BYTES} bytes")
        )
    return text
