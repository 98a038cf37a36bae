"""Functions that a worker runs on the folder of a recorded run."""

from pathlib import Path

from svsa.runs.records.export.formats import export
from svsa.runs.records.reader import open_record
from svsa.runs.records.resimulation import Comparison, compare_with_simulation
from svsa.teaching.leaderboard.board import Board


def write_export(kind: str, folder: Path, target: Path) -> None:
    """Export the record in this folder."""
    export(open_record(folder), kind, target)


def write_worst_run(key: str, folder: Path, target: Path) -> None:
    """Build the page of an entry's worst run, with 3D replay."""
    from svsa_server.runs.worst_run_page import build_worst_run_page

    board = Board(folder)
    target.write_text(build_worst_run_page(board, board.get(key)), encoding="utf-8")


def compare(folder: Path) -> Comparison:
    """Compare the record in this folder with its simulation."""
    return compare_with_simulation(open_record(folder))
