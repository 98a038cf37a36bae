"""What a worker makes of a recorded run, by its folder."""

from pathlib import Path

from svsa.runs.records.export.formats import export
from svsa.runs.records.reader import open_record
from svsa.runs.records.resimulation import Comparison, compare_with_simulation
from svsa.teaching.leaderboard.board import Board


def write_export(kind: str, folder: Path, target: Path) -> None:
    """The record in this folder as a file of another program."""
    export(open_record(folder), kind, target)


def write_worst_run(key: str, folder: Path, target: Path) -> None:
    """The worst run of an entry of the board in this folder as a page with 3D replay."""
    from svsa_server.runs.worst_run_page import build_worst_run_page

    board = Board(folder)
    target.write_text(build_worst_run_page(board, board.get(key)), encoding="utf-8")


def compare(folder: Path) -> Comparison:
    """The record in this folder against its simulation."""
    return compare_with_simulation(open_record(folder))
