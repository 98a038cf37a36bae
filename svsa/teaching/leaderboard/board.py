"""The leaderboard: a folder with the season's secret and one file per entry."""

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
from svsa.inputs.data_folder import find_data_folder
from svsa.inputs.extras import __version__
from svsa.runs.records.header import replace_file
from svsa.teaching.class_folder import ClassFolder
from svsa.teaching.grading.law_runs import run_installed, run_law
from svsa.teaching.isolation.confinement import Bounds, confine
from svsa.teaching.isolation.process import Place
from svsa.teaching.leaderboard.standing import (
    ReportProgress,
    RunScenario,
    Standing,
    build_season,
    measure_standing,
)
from svsa.teaching.submission import digest_law

FOLDER = "leaderboard"
MAX_NAME = 60
_TICK_BYTES = 16
_KEY = re.compile(r"[a-z0-9_]{1,64}")
LAW_LIMITS = Bounds(whole_s=60.0)


def _check_name(name: str) -> str:
    if not name.strip() or not name.isprintable():
        raise ValueError("letters on one line")
    return name.strip()


def _check_author(name: str) -> str:
    return _check_name(name) if name.strip() else ""


EntryName = Annotated[str, AfterValidator(_check_name)]
Author = Annotated[str, AfterValidator(_check_author)]


class Entry(Checked):
    """An entry: a law with its results; `key` is the name of an installed law, otherwise the
    SHA-256 of its file.
    """

    key: str = quantity("", "Name of an installed law, or SHA-256 of a submitted file")
    name: EntryName = quantity("", "Name of the entry on the leaderboard", max_length=MAX_NAME)
    author: Author = quantity(
        "", "Author of a submitted law, or empty", max_length=MAX_NAME, default=""
    )
    person: str = quantity("", "Id of the author in a class, or empty", max_length=60, default="")
    is_installed: Flag = quantity("", "Whether the law is installed in the lab")
    entered: str = quantity("", "Time of the measurement, UTC, ISO 8601")
    suite: str = quantity("", "Version of the trials")
    version: str = quantity("", "Version of the lab")
    standing: Standing = quantity("", "Results of the law")


class Board(ClassFolder[Entry]):
    """The folder of a season: `secret`, readable by the server only, and one file per entry.

    `torques/` has the torques of submitted laws in their worst runs. The secret is generated when
    the folder is created. To end a season, move its folder.

    Args:
        folder: The folder; None for that in the data folder.

    Raises:
        ParameterError: If the folder cannot be used.
    """

    def __init__(self, folder: Path | None = None) -> None:
        folder = find_data_folder() / FOLDER if folder is None else folder
        super().__init__(folder, Entry, ("leaderboard", "entries", "torques"))
        self.season = build_season(derive_seed(self.secret))

    @classmethod
    def find_started(cls, folder: Path) -> Self | None:
        """Open the leaderboard in a folder; None before the season's secret is drawn."""
        return cls(folder) if (folder / "secret").exists() else None

    def find(self, key: str) -> Entry | None:
        """Find the entry of a key, measured with the current trials (and lab, if installed)."""
        entry = super().find(key) if _KEY.fullmatch(key) else None
        return entry if entry is not None and _is_present(entry) else None

    def get(self, key: str) -> Entry:
        """Return the entry of a key.

        Raises:
            ParameterError: If there is none.
        """
        entry = self.find(key)
        if entry is None:
            raise ParameterError(Violation("entry", key, "", "the key of an entry of this season"))
        return entry

    def list_missing(self) -> list[str]:
        """List the names of installed laws without an entry, or with a damaged one."""
        keys = {entry.key for entry in self.list()}
        return [name for name in list_law_names() if name not in keys]

    def keep(self, entry: Entry, torques: bytes = b"") -> Entry:
        """Save an entry; `torques` are those of a submitted law's worst run, float64 (ticks, 2), as
        bytes.
        """
        if torques:
            replace_file(self.others / entry.key, torques)
        self.write(entry.key, entry)
        return entry

    def read_torques(self, entry: Entry) -> np.ndarray:
        """Read (u1, u2) of a submitted law at every tick of its worst run, N·m, (ticks, 2).

        Raises:
            StateError: If none are saved: the law failed before its first answer, or the entry is
                from an earlier version of the lab.
        """
        path = self.others / entry.key
        kept = path.read_bytes() if path.exists() else b""
        if not kept or len(kept) % _TICK_BYTES:
            raise StateError(f"The torques of the worst run of {entry.name!r} are not saved.")
        return np.frombuffer(kept).reshape(-1, 2)

    def list(self) -> list[Entry]:
        """Return all entries, the highest success rate first."""
        entries = [entry for entry in self.read_all() if _is_present(entry)]
        return sorted(entries, key=lambda entry: (-entry.standing.success, entry.name, entry.key))


def rank_entries(entries: Sequence[Entry]) -> list[int]:
    """Rank entries by success rate, 1 is the highest; equal rates share a rank."""
    rates = [entry.standing.success for entry in entries]
    return [1 + sum(other > rate for other in rates) for rate in rates]


def measure_missing(
    board: Board,
    report: ReportProgress = lambda done, total: None,
    is_cancelled: Callable[[], bool] = lambda: False,
) -> bool:
    """Measure the installed laws without an entry; return whether all were measured.

    `report` receives (finished runs, all runs).
    """
    names, count = board.list_missing(), board.season.run_count
    for number, name in enumerate(names):

        def note(done: int, _: int, before: int = number * count) -> None:
            report(before + done, len(names) * count)

        measured = measure_standing(board.season, partial(run_installed, name), note, is_cancelled)
        if measured is None:
            return False
        board.keep(build_entry(name, name, True, measured.standing))
    return True


def submit(
    board: Board,
    name: str,
    source: bytes,
    report: ReportProgress = lambda done, total: None,
    is_cancelled: Callable[[], bool] = lambda: False,
    author: str = "",
    person: str = "",
) -> Entry | None:
    """Measure a submitted law in isolation and save its entry; return None if cancelled.

    A file that was submitted before keeps its entry. Also raises the errors of `measure_standing`.

    Raises:
        NotIsolatedError: If this machine cannot isolate a law.
    """
    key = digest_law(source)
    before = board.find(key)
    if before is not None:
        return before
    measured = measure_standing(board.season, build_isolated_runner(source), report, is_cancelled)
    if measured is None:
        return None
    entry = build_entry(key, name, False, measured.standing, author, person)
    return board.keep(entry, measured.worst.torques)


def build_isolated_runner(source: bytes, place: Place = confine) -> RunScenario:
    """Build the function that runs a law's file in a scenario, in isolation."""
    return partial(run_law, source, bounds=LAW_LIMITS, place=place)


def build_entry(
    key: str,
    name: str,
    is_installed: bool,
    standing: Standing,
    author: str = "",
    person: str = "",
) -> Entry:
    """Build the entry of a law that was just measured with this version of the lab."""
    return Entry(
        key=key,
        name=name,
        author=author,
        person=person,
        is_installed=is_installed,
        entered=datetime.now(UTC).isoformat(timespec="seconds"),
        suite=PROTOCOL,
        version=__version__,
        standing=standing,
    )


def _is_present(entry: Entry) -> bool:
    """Whether an entry has the current trials and, for an installed law, the current lab."""
    if entry.suite != PROTOCOL:
        return False
    return not entry.is_installed or (
        entry.version == __version__ and entry.key in list_law_names()
    )
