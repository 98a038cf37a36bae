"""The folder of a class or a season: a secret seed for trials, and one file per result."""

import logging
import os
import secrets
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Generic, TypeVar

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked
from svsa.inputs.set_aside import set_aside
from svsa.inputs.stored_file import read_json
from svsa.runs.records.former_words import translate_results
from svsa.runs.records.header import replace_file

SECRET_BYTES = 32
_log = logging.getLogger(__name__)
T = TypeVar("T", bound=Checked)


class ClassFolder(Generic[T]):
    """A folder with a file `secret`, a folder of results, and a folder of further files.

    The secret is generated when the folder is created.

    Args:
        kind: Type of a result.
        names: Name of the folder in an error, of the results' folder, and of that of further files.

    Raises:
        ParameterError: If the folder cannot be used.
    """

    def __init__(self, folder: Path, kind: type[T], names: tuple[str, str, str]) -> None:
        name, results, others = names
        self.folder, self._kind = folder, kind
        self._results, self.others = folder / results, folder / others
        try:
            self._results.mkdir(parents=True, exist_ok=True)
            self.others.mkdir(exist_ok=True)
            self.secret = keep_secret(folder / "secret")
        except OSError as error:
            bound = f"a folder that can be written ({error.strerror})"
            raise ParameterError(Violation(name, folder, "", bound)) from None

    @property
    def began(self) -> str:
        """When the secret was drawn, UTC, ISO 8601."""
        made_s = (self.folder / "secret").stat().st_mtime
        return datetime.fromtimestamp(made_s, UTC).isoformat(timespec="seconds")

    def find(self, key: str) -> T | None:
        """Read the result of a key; return None if there is none.

        Raises:
            ParameterError: If the file of the result cannot be read.
        """
        path = self._results / f"{key}.json"
        return self._read(path) if path.exists() else None

    def write(self, key: str, result: T) -> None:
        """Save a result atomically.

        Raises:
            OSError: If the file cannot be written.
        """
        path = self._results / f"{key}.json"
        if path.is_dir():
            set_aside(path)
        replace_file(path, (result.model_dump_json(indent=1) + "\n").encode())

    def read_all(self) -> Iterator[T]:
        """Yield every readable result, in arbitrary order; a damaged one is logged, and stays."""
        for path in self._results.glob("*.json"):
            try:
                yield self._read(path)
            except ParameterError as error:
                _log.warning("A result is left out: %s", error)

    def _read(self, path: Path) -> T:
        try:
            return self._kind.model_validate(translate_results(read_json(path)))
        except (OSError, ValueError, TypeError, AttributeError) as error:
            name = self._kind.__name__.lower()
            raise ParameterError(Violation(name, path, "", f"one of svsa ({error})")) from None


def keep_secret(path: Path) -> bytes:
    """Return the secret in this file; generate one if there is none. Other accounts cannot read it.

    An earlier version may have left an empty file on a full disk: then the secret is generated
    again.

    Raises:
        ParameterError: If the file contains something else.
        OSError: If the file cannot be written or read.
    """
    if not path.exists() or not path.stat().st_size:
        _write_new(path, secrets.token_bytes(SECRET_BYTES))
    secret = path.read_bytes()
    if len(secret) != SECRET_BYTES:
        raise ParameterError(Violation("secret", path, "", f"of {SECRET_BYTES} bytes"))
    return secret


def _write_new(path: Path, content: bytes) -> None:
    """Write a file atomically; if two processes write at once, the first one's content stays."""
    draft = path.with_name(f"{path.name}.{secrets.token_hex(4)}.part")
    try:
        opened = os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with os.fdopen(opened, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        if path.exists() and not path.stat().st_size:
            path.unlink()
        # Linking fails if the other process was first; replacing would not.
        try:
            path.hardlink_to(draft)
        except FileExistsError:
            return
        except OSError:
            draft.replace(path)  # some network file systems have no links
    finally:
        draft.unlink(missing_ok=True)
