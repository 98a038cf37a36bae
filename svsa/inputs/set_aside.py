"""Damaged files: kept under another name, so that a new one can take their place."""

import contextlib
import os
from pathlib import Path

SQLITE_FILES = ("-wal", "-shm", "-journal")
"""Endings of a database's other files: SQLite would apply them to a new one of the same name."""


def set_aside(path: Path, endings: tuple[str, ...] = ()) -> Path:
    """Rename a damaged file.

    Args:
        path: The file.
        endings: Endings of further files that belong to it.

    Returns:
        Its new path, `….damaged-1` or the next free number.

    Raises:
        OSError: If it cannot be renamed.
    """
    number = 1
    while os.path.lexists(aside := path.with_name(f"{path.name}.damaged-{number}")):
        number += 1
    for ending in ("", *endings):
        with contextlib.suppress(FileNotFoundError):
            path.with_name(path.name + ending).rename(f"{aside}{ending}")
    return aside
