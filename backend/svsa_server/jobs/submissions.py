"""A law for the leaderboard as a job: its season, then installed laws without an entry."""

from pathlib import Path
from typing import NamedTuple

from svsa.teaching.leaderboard.board import Board, measure_missing, submit
from svsa_server.jobs.progress import JobFolder


class Asked(NamedTuple):
    """What is to be measured. board: the season's folder. law: its text, None for the lab's.

    author: who submits it.
    """

    board: Path
    name: str
    law: bytes | None
    author: str = ""


def enter(folder: JobFolder, asked: Asked) -> bool:
    """Measure laws in a worker; return whether all were measured. Existing entries stay.

    While a law is measured it tells of the law's runs alone: then the law has its entry.
    """
    board = Board(asked.board)
    first = 0 if asked.law is None else board.season.run_count

    def report_missing(done: int, total: int) -> None:
        folder.report(first + done, first + total)

    if asked.law is not None:
        entry = submit(
            board, asked.name, asked.law, folder.report, folder.is_cancelled, asked.author
        )
        if entry is None:
            return False
    return measure_missing(board, report_missing, folder.is_cancelled)
