"""The trials of a search in a file, so that it continues after Ctrl-C or a kill."""

import json
from pathlib import Path
from typing import Any

from svsa.control.installed import get_law
from svsa.inputs.extras import __version__
from svsa.inputs.stored_file import load_json, read_file
from svsa.numerics.compilation import find_fingerprint
from svsa.runs.records.header import replace_file


class Journal:
    """A file with a line of JSON for each finished trial, or group of trials.

    Attributes:
        known: The trials in the file; none if it is damaged, or of another definition.

    Args:
        path: The file, created with the first trial; None to save nothing.
        definition: What determines the trials, as JSON; None if the name of the file does.
    """

    def __init__(self, path: Path | None, definition: dict[str, Any] | None = None) -> None:
        self._path, self._is_begun = path, False
        self._head = [] if definition is None else [json.loads(json.dumps(definition))]
        try:
            lines = [] if path is None else read_lines(path)
        except ValueError:
            lines = []
        is_same = lines[: len(self._head)] == self._head
        self.known: list[Any] = lines[len(self._head) :] if is_same else []

    def write(self, trial: Any) -> None:
        """Add a trial.

        Args:
            trial: Its parameters and results, as JSON.

        Raises:
            OSError: If the file cannot be written.
        """
        if self._path is None:
            return
        if not self._is_begun:
            # Without an incomplete last line, after which the next one could not be read.
            replace_file(self._path, "".join(map(_format, [*self._head, *self.known])).encode())
            self._is_begun = True
        with self._path.open("a", encoding="utf-8") as file:
            file.write(_format(trial))

    def remove(self) -> None:
        """Delete the file of a finished search."""
        if self._path is not None:
            self._path.unlink(missing_ok=True)


def define_search(law: str, **settings: Any) -> dict[str, Any]:
    """Define the trials of a law by settings, its code, and the version of the lab.

    Args:
        law: Name of the law.
        **settings: What else determines the trials, as JSON.

    Returns:
        The definition of a `Journal`.
    """
    code = find_fingerprint(get_law(law).control.py_func)
    return {"version": __version__, "law": law, "code": code} | settings


def read_lines(path: Path) -> list[Any]:
    """Read the complete lines of a journal; none if it does not exist.

    Args:
        path: The file.

    Returns:
        The content of each line.

    Raises:
        ValueError: If a line is damaged.
    """
    if not path.exists():
        return []
    whole, _, _ = read_file(path).rpartition(b"\n")
    return [load_json(line) for line in whole.splitlines()]


def _format(trial: Any) -> str:
    return json.dumps(trial) + "\n"
