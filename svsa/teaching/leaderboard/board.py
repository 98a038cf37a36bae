"""The board: a folder with the season's secret and an entry a file."""

import re
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Annotated, Self

import numpy as np
from pydantic import AfterValidator

from svsa.control.installed import list_law_names
from svsa.errors import ParameterError, StateError, Violation
from svsa.evaluation.trials import PROTOCOL, derive_seed
from svsa.inputs.checked import Checked, Flag, quantity
from svsa.inputs.extras import __version__
from svsa.runs.records.catalogue.runs import find_data_folder
from svsa.runs.records.header import replace_file
from svsa.teaching.class_folder import ClassFolder
from svsa.teaching.grading.law_runs import run_installed, run_law
from svsa.teaching.isolation.confinement import Bounds, confine
from svsa.teaching.isolation.process import Place
from svsa.teaching.leaderboard.standing import Go, Standing, Tell, build_season, measure_standing
from svsa.teaching.submission import digest_law

FOLDER = "leaderboard"
MAX_NAME = 60
_TICK_BYTES = 16
_KEY = re.compile(r"[a-z0-9_]{1,64}")
BOUNDS = Bounds(whole_s=60.0)


def _check_name(name: str) -> str:
    if not name.strip() or not name.isprintable():
        raise ValueError("letters on one line")
    return name.strip()


def _check_author(name: str) -> str:
    return _check_name(name) if name.strip() else ""


EntryName = Annotated[str, AfterValidator(_check_name)]
Author = Annotated[str, AfterValidator(_check_author)]


class Entry(Checked):
    """A law on the board. key: its name where it is installed, else SHA-256 of its text."""

    key: str = quantity("", "Name of an installed law, or SHA-256 of a law's text")
    name: EntryName = quantity("", "What it is called on the board", max_length=MAX_NAME)
    author: Author = quantity("", "Who submitted it, or empty", max_length=MAX_NAME, default="")
    is_installed: Flag = quantity("", "Whether it is a law of the lab, compiled")
    entered: str = quantity("", "When it was measured, UTC, ISO 8601")
    suite: str = quantity("", "Version of the suite")
    version: str = quantity("", "Version of the lab")
    standing: Standing = quantity("", "What it shows")


class Board(ClassFolder[Entry]):
    """A season's folder: `secret`, readable by the server only, and `entries/`, a file each.

    `torques/` has what submitted laws answered in their worst runs. folder: None for the one in
    this machine's data folder. The secret is drawn when the board is begun; a season ends when its
    folder is put away. Raises `ParameterError` where the folder cannot be used.
    """

    def __init__(self, folder: Path | None = None) -> None:
        folder = find_data_folder() / FOLDER if folder is None else folder
        super().__init__(folder, Entry, ("leaderboard", "entries", "torques"))
        self.season = build_season(derive_seed(self.secret))

    @classmethod
    def find_started(cls, folder: Path) -> Self | None:
        """The board of a folder; None before the season's secret is drawn."""
        return cls(folder) if (folder / "secret").exists() else None

    def find(self, key: str) -> Entry | None:
        """The entry of this key in this version of the suite; of an installed law, of the lab."""
        entry = super().find(key) if _KEY.fullmatch(key) else None
        return entry if entry is not None and _is_present(entry) else None

    def get(self, key: str) -> Entry:
        """The same; raises `ParameterError` where there is none."""
        entry = self.find(key)
        if entry is None:
            raise ParameterError(Violation("entry", key, "", "the key of an entry of this season"))
        return entry

    def list_missing(self) -> list[str]:
        """Names of installed laws that have no entry yet."""
        return [name for name in list_law_names() if self.find(name) is None]

    def keep(self, entry: Entry, torques: bytes = b"") -> Entry:
        """Keep an entry, with what a law in a process of its own answered in its worst run."""
        if torques:
            replace_file(self.others / entry.key, torques)
        self.write(entry.key, entry)
        return entry

    def read_torques(self, entry: Entry) -> np.ndarray:
        """(u1, u2) of a submitted law at every tick of its worst run, N·m, (ticks, 2).

        Raises `StateError` where none is kept: it failed before it answered, or is of an earlier
        version of the lab.
        """
        path = self.others / entry.key
        kept = path.read_bytes() if path.exists() else b""
        if not kept or len(kept) % _TICK_BYTES:
            raise StateError(f"Of the worst run of {entry.name!r} nothing is kept.")
        return np.frombuffer(kept).reshape(-1, 2)

    def list(self) -> list[Entry]:
        """Every entry, the best success rate first."""
        entries = [one for one in self.read_all() if _is_present(one)]
        return sorted(entries, key=lambda one: (-one.standing.success, one.name, one.key))


def rank_entries(entries: Sequence[Entry]) -> list[int]:
    """The place of each entry by success rate, 1 the best; equal rates share a place."""
    rates = [one.standing.success for one in entries]
    return [1 + sum(other > rate for other in rates) for rate in rates]


def measure_missing(
    board: Board,
    report: Tell = lambda done, total: None,
    is_cancelled: Callable[[], bool] = lambda: False,
) -> bool:
    """Measure the installed laws that have no entry; whether it came to its end.

    report: is given how many runs are done, and of how many.
    """
    names, count = board.list_missing(), board.season.run_count
    for number, name in enumerate(names):

        def note(done: int, _: int, before: int = number * count) -> None:
            report(before + done, len(names) * count)

        found = measure_standing(board.season, partial(run_installed, name), note, is_cancelled)
        if found is None:
            return False
        board.keep(build_entry(name, name, True, found.standing))
    return True


def submit(
    board: Board,
    name: str,
    source: bytes,
    report: Tell = lambda done, total: None,
    is_cancelled: Callable[[], bool] = lambda: False,
    author: str = "",
) -> Entry | None:
    """Put a law's text through the season, isolated, and keep what it shows; None if broken off.

    The same text has one entry, which stays as it is. Raises `NotIsolatedError` where this machine
    cannot hold a law, and what `measure_standing` does.
    """
    key = digest_law(source)
    before = board.find(key)
    if before is not None:
        return before
    found = measure_standing(board.season, go_isolated(source), report, is_cancelled)
    if found is None:
        return None
    return board.keep(build_entry(key, name, False, found.standing, author), found.worst.torques)


def go_isolated(source: bytes, place: Place = confine) -> Go:
    """Runs of a law's text. place: `leave_open` for a law that is trusted."""
    return partial(run_law, source, bounds=BOUNDS, place=place)


def build_entry(
    key: str, name: str, is_installed: bool, standing: Standing, author: str = ""
) -> Entry:
    """An entry that was measured just now, with this lab."""
    return Entry(
        key=key,
        name=name,
        author=author,
        is_installed=is_installed,
        entered=datetime.now(UTC).isoformat(timespec="seconds"),
        suite=PROTOCOL,
        version=__version__,
        standing=standing,
    )


def _is_present(entry: Entry) -> bool:
    """Whether it was measured with this suite; an installed law, also with this lab."""
    if entry.suite != PROTOCOL:
        return False
    return not entry.is_installed or (
        entry.version == __version__ and entry.key in list_law_names()
    )
