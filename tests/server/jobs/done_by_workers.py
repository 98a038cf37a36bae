"""Jobs for a worker, which imports this file and no other test file."""

import os
import time
from pathlib import Path

from svsa.errors import ParameterError, Violation


def get_process() -> tuple[int, int]:
    return os.getpid(), os.nice(0)


def wait_for(path: Path) -> None:
    while not path.exists():
        time.sleep(0.02)


def refuse(name: str) -> None:
    raise ParameterError(Violation(name, 9.0, "Hz", "at most 5 Hz"))


def end() -> None:
    os._exit(1)


def note_and_sleep(note: Path) -> None:
    """Create a file, then sleep: its existence shows that the job runs."""
    note.touch()
    time.sleep(300.0)
