"""`svsa ranking submit` and `svsa ranking leaderboard`: laws on hidden trials."""

import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from svsa.control.installed import get_title
from svsa.evaluation.progress_bar import show_progress
from svsa.evaluation.ranking.scenarios import PUBLIC_SEED
from svsa.teaching.isolation.confinement import leave_open
from svsa.teaching.leaderboard.board import (
    Board,
    Entry,
    build_entry,
    build_isolated_runner,
    measure_missing,
    rank_entries,
    submit,
)
from svsa.teaching.leaderboard.standing import ReportProgress, build_season, measure_standing
from svsa.teaching.submission import read_law

_messages = Console(stderr=True)
_BOARD = typer.Option("--board", help="Folder of the season; default: leaderboard in SVSA_DATA.")
_JSON = typer.Option("--json", help="Print JSON.")
_HEADINGS = (
    "", "law", "by", "held", "95 %", "trials", "ended", "rms, median", "µs/tick", "worst",
)  # fmt: skip
MIN_WIDTH = 110
"""Width of the terminal, in characters, that shows the table's numbers without wrapping."""


def submit_command(
    file: Annotated[
        Path,
        typer.Argument(metavar="LAW.PY", help="Python file of the law, with `law` or `build`."),
    ],
    name: Annotated[
        str | None, typer.Option(help="Name of the entry; default: the name of the file.")
    ] = None,
    author: Annotated[str, typer.Option(help="Author shown on the leaderboard.")] = "",
    practice: Annotated[
        bool,
        typer.Option(
            "--practice", help="For students: public trials, without isolation; nothing is stored."
        ),
    ] = False,
    folder: Annotated[Path | None, _BOARD] = None,
    as_json: Annotated[bool, _JSON] = False,
) -> None:
    """Submit a law: measure it on the season's hidden trials, in isolation, and show its rank.

    A file that was submitted before keeps its entry.
    """
    source, called = read_law(file), name or file.stem
    if practice:
        run_scenario = build_isolated_runner(source, leave_open)
        with _show_progress("Practice") as report:
            measured = measure_standing(build_season(PUBLIC_SEED), run_scenario, report)
        own = measured and build_entry("practice", called, False, measured.standing, author)
        _show([own] if own else [], as_json, "practice on public trials, not isolated")
        return
    board = Board(folder)
    with _show_progress(called) as report:
        entry = submit(board, called, source, report, author=author)
    with _show_progress("Laws of the lab") as report:
        measure_missing(board, report)
    _show(board.list(), as_json, "hidden trials", entry and entry.key)


def leaderboard_command(
    folder: Annotated[Path | None, _BOARD] = None, as_json: Annotated[bool, _JSON] = False
) -> None:
    """Show the entries of the season by rank; measure installed laws without an entry first."""
    board = Board(folder)
    with _show_progress("Laws of the lab") as report:
        measure_missing(board, report)
    _show(board.list(), as_json, "hidden trials")


@contextmanager
def _show_progress(title: str) -> Iterator[ReportProgress]:
    with show_progress(_messages, escape(title)) as report:
        yield lambda done, total: report(done, total=total)


def _show(entries: Sequence[Entry], as_json: bool, trials: str, marked: str | None = None) -> None:
    if as_json:
        print(json.dumps([entry.model_dump(mode="json") for entry in entries], indent=2))
        return
    screen = Console()
    Console(width=max(screen.width, MIN_WIDTH)).print(_build_table(entries, trials, marked))


def _build_table(entries: Sequence[Entry], trials: str, marked: str | None) -> Table:
    table = Table(
        box=SIMPLE_HEAD,
        padding=(0, 1, 0, 0),
        title=f"Leaderboard: {trials}",
        title_justify="left",
        caption="Held: no fault, in the last second at most 1° and 10 % of σ_d, peak at most 30°."
        " µs/tick: wall time, including the plant and, for an isolated law (*), the communication."
        " Worst: largest error among the public scenarios.",
        caption_justify="left",
    )
    for heading in _HEADINGS:
        table.add_column(heading, justify="left" if heading in ("law", "by", "worst") else "right")
    for place, entry in zip(rank_entries(entries), entries, strict=True):
        table.add_row(
            str(place), *_build_cells(entry), style="bold" if entry.key == marked else None
        )
    return table


def _build_cells(entry: Entry) -> tuple[str, ...]:
    shown, worst = entry.standing, entry.standing.worst
    name = get_title(entry.key) if entry.is_installed else f"{entry.name} *"
    error = "ended early" if worst.rms_deg is None else f"{worst.rms_deg:.3g}°"
    return (
        escape(name),
        "lab" if entry.is_installed else escape(entry.author),
        f"{shown.success:.1%}",
        f"{shown.low:.1%}–{shown.high:.1%}",
        f"{shown.trials_held}/{shown.trials}",
        str(shown.trials_ended),
        "ended early" if shown.median_rms_deg is None else f"{shown.median_rms_deg:.3g}°",
        "" if shown.tick_us is None else f"{shown.tick_us:.1f}",
        escape(f"{worst.scenario}: {error}"),
    )
