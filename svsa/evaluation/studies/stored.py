"""A saved study and its folder."""

from pathlib import Path
from typing import NamedTuple

from svsa.errors import SvsaError
from svsa.evaluation.studies.study import Study

EXAMPLES = Path(__file__).parent / "examples"


class StudyError(SvsaError):
    """A study that cannot be saved, read or continued; finished parts stay."""


class StoredStudy(NamedTuple):
    """A study and its folder; `owner` is the id of the user who started it in a class, otherwise
    empty.
    """

    name: str
    study: Study
    folder: Path
    created: str
    version: str
    owner: str = ""

    @property
    def is_example(self) -> bool:
        """Whether it is the study in the package."""
        return self.folder.parent == EXAMPLES
