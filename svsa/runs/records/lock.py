"""Who writes a record: a lock on its stream that the system takes back when a process dies."""

import contextlib
from collections.abc import Iterator
from pathlib import Path

from svsa.inputs.file_lock import try_lock
from svsa.runs.records.header import STREAM_FILE


@contextlib.contextmanager
def claim(folder: Path) -> Iterator[bool]:
    """Be the only one to finish a record; False where somebody, this process too, writes it."""
    try:
        file = (folder / STREAM_FILE).open("rb")
    except OSError:
        yield True
        return
    with file:
        yield try_lock(file.fileno())
