"""A law for the leaderboard as a job: its season, then installed laws without an entry."""

from pathlib import Path
from typing import NamedTuple

from svsa.teaching.leaderboard.board import Board, measure_missing, submit
from svsa_server.jobs.progress import JobFolder


class Task(NamedTuple):
    """A request for measuring a law.

    Attributes:
        board: Folder of the season.
        name: Name of the law.
        law: Text of the law, None for the laws of the lab.
        author: Author of the law.
        person: Id of the author in a class.
    """

    board: Path
    name: str
    law: bytes | None
    author: str = ""
    person: str = ""


def measure_laws(folder: JobFolder, task: Task) -> bool:
    """Measure laws in a worker; return whether all were measured. Existing entries stay.

    While a submitted law is measured, progress counts its runs only; after that it has its entry.
    """
    board = Board(task.board)
    first = 0 if task.law is None else board.season.run_count

    def report_missing(done: int, total: int) -> None:
        folder.report(first + done, first + total)

    if task.law is not None:
        by = (task.author, task.person)
        entry = submit(board, task.name, task.law, folder.report, folder.is_cancelled, *by)
        if entry is None:
            return False
    return measure_missing(board, report_missing, folder.is_cancelled)
