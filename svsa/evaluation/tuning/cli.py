"""`svsa tune`: search a law's parameters, and write them to a parameter file."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.table import Table

from svsa.control.installed import check_installed, get_title, list_law_names
from svsa.errors import ParameterError, Violation
from svsa.evaluation.progress_bar import Report, show_progress

_messages = Console(stderr=True)
INTERRUPTED = 130
RANKING_BUDGET, BUDGET = 2000, 128

if TYPE_CHECKING:
    from svsa.evaluation.tuning.tuner import Candidate, Tuned


def tune(
    law: Annotated[str | None, typer.Argument(help="Name of an installed law.")] = None,
    every: Annotated[
        bool, typer.Option("--all", help="Tune all installed laws for the ranking.")
    ] = False,
    budget: Annotated[
        int | None,
        typer.Option(min=1, help="Number of candidates; default: 128, with --all 2000."),
    ] = None,
    trials: Annotated[int, typer.Option(min=1, help="Training trials of each candidate.")] = 128,
    validation: Annotated[
        int, typer.Option(min=1, help="Validation trials of the best ten candidates.")
    ] = 512,
    seed: Annotated[
        int, typer.Option(min=0, help="Seed of search, training and validation trials.")
    ] = 0,
    hold: Annotated[
        list[str] | None,
        typer.Option(help="NAME=VALUE: a parameter with a fixed value; repeatable."),
    ] = None,
    parameters: Annotated[
        Path | None, typer.Option(help="Parameter file with the initial parameters (TOML).")
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            help="Parameter file to write; default: LAW.toml. With --all: folder of the results;"
            " default: the folder of the ranking."
        ),
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print all candidates as JSON, and write no file.")
    ] = False,
) -> None:
    """Tune a law, or all laws for the ranking. Ctrl-C ends the search and saves the best so far.

    --all skips laws that have a result with the same budget, and continues an interrupted search
    from its checkpoint.
    """
    if every == (law is not None):
        raise ParameterError(Violation("law", law, "", "one law, or --all"))
    if every:
        _tune_all(budget or RANKING_BUDGET, trials, validation, seed, output)
        return
    from svsa.evaluation.tuning.file import describe_tuned
    from svsa.evaluation.tuning.tuner import tune as search
    from svsa.runs.design_file import read_design

    name = check_installed(law or "")
    count = budget or BUDGET
    with show_progress(_messages, get_title(name), count, "candidates") as report:
        tuned = search(
            name,
            budget=count,
            trials=trials,
            validation=validation,
            seed=seed,
            held=dict(map(_read_held, hold or ())),
            present=None if parameters is None else read_design(parameters),
            on_candidate=_Follow(report, get_title(name)),
        )
    if as_json:
        typer.echo(json.dumps(describe_tuned(tuned), indent=2))
    else:
        _save(tuned, output or Path(f"{name}.toml"))
    if not tuned.is_complete:
        raise typer.Exit(INTERRUPTED)


def _tune_all(budget: int, trials: int, validation: int, seed: int, output: Path | None) -> None:
    """Tune every installed law in turn, with a checkpoint each."""
    from svsa.evaluation.tuning.file import describe_candidate, read_checkpoint
    from svsa.evaluation.tuning.tuned_law import (
        FOLDER,
        build_tuned_law,
        list_tuned_laws,
        write_tuned_law,
    )
    from svsa.evaluation.tuning.tuner import tune as search

    folder = output or FOLDER
    arguments = budget, trials, validation, seed
    done = {
        tuned.law
        for tuned in list_tuned_laws(folder)
        if (tuned.candidates, tuned.trials, tuned.validation, tuned.seed) == arguments
    }
    for law in list_law_names():
        if law in done:
            continue
        checkpoint = folder / f"{law}.{budget}-{trials}-{seed}.jsonl"
        checkpoint.parent.mkdir(parents=True, exist_ok=True)
        known = read_checkpoint(checkpoint)
        with (
            show_progress(_messages, get_title(law), budget, "candidates") as report,
            checkpoint.open("a", encoding="utf-8") as lines,
        ):
            follow = _Follow(report, get_title(law))

            def note(candidate: "Candidate", follow: "_Follow" = follow) -> None:
                if candidate.stage != "validation" and candidate.number >= len(known):  # noqa: B023  used before the next law begins
                    lines.write(json.dumps(describe_candidate(candidate)) + "\n")
                    lines.flush()
                follow(candidate)

            tuned = search(
                law, budget=budget, trials=trials, validation=validation, seed=seed, known=known,
                on_candidate=note,
            )  # fmt: skip
        if not tuned.is_complete:
            raise typer.Exit(INTERRUPTED)
        write_tuned_law(folder, build_tuned_law(tuned))
        checkpoint.unlink()
        before, after = tuned.finals[0].judgment, tuned.best.judgment
        _messages.print(
            f"{get_title(law)}: cost {before.cost:.3f} → {after.cost:.3f}, held {before.held} →"
            f" {after.held} of {validation}, torque variation"
            f" {after.torque_variation_nm_per_s:.0f} N·m/s",
            highlight=False,
        )


class _Follow:
    """Shows the candidates of a search on a progress bar."""

    def __init__(self, report: Report, title: str) -> None:
        self._report, self._title = report, title
        self._best = float("inf")

    def __call__(self, candidate: "Candidate") -> None:
        self._best = min(self._best, candidate.judgment.cost)
        self._report(candidate.number, f"{self._title}: best {self._best:.4g}")


def _save(tuned: "Tuned", path: Path) -> None:
    """Write the parameter file and print the result."""
    from svsa.evaluation.tuning.file import format_tuned

    path.write_text(format_tuned(tuned), encoding="utf-8")
    console = Console()
    console.print(_build_value_table(tuned), _build_cost_table(tuned), highlight=False)
    if not tuned.is_complete:
        tried = len(tuned.candidates) - 1
        console.print(f"Interrupted after {tried} of {tuned.budget} candidates.")
    console.print(f"Parameter file: {path}", highlight=False)


def _read_held(text: str) -> tuple[str, float]:
    name, equals, value = text.partition("=")
    try:
        if equals:
            return name.strip(), float(value)
    except ValueError:
        pass
    raise ParameterError(
        Violation("hold", text, "", "NAME=VALUE with a decimal point, as estimate_share=0.5")
    )


def _build_value_table(tuned: "Tuned") -> Table:
    table = Table("", title=get_title(tuned.space.law), title_justify="left")
    for column in ("before", "tuned", "searched", "unit"):
        table.add_column(column, justify="left" if column == "unit" else "right")
    rows = zip(tuned.space.axes, tuned.start.values, tuned.best.values, strict=True)
    for axis, old, new in rows:
        ends = f"{axis.low:.4g} … {axis.high:.4g}"
        table.add_row(axis.label, f"{old:.4g}", f"{new:.4g}", ends, axis.unit)
    return table


def _build_cost_table(tuned: "Tuned") -> Table:
    title = "Validation trials" if tuned.finals else "Training trials"
    table = Table("", title=title, title_justify="left")
    for column in ("cost", "held", "rms e, °", "rms eσ, %", "torque variation at rest, N·m/s"):
        table.add_column(column, justify="right")
    before = tuned.finals[0] if tuned.finals else tuned.start
    for name, candidate in (("before", before), ("tuned", tuned.best)):
        judgment = candidate.judgment
        errors = (judgment.position_error_deg, judgment.stiffness_error_percent)
        cells = ("–" if error is None else f"{error:.3g}" for error in errors)
        variation = f"{judgment.torque_variation_nm_per_s:.0f}"
        table.add_row(
            name, f"{judgment.cost:.4f}", f"{judgment.held} of {judgment.trials}", *cells, variation
        )
    return table
