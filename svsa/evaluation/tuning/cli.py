"""`svsa tune`: search a law's parameters, and write them to a parameter file."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.table import Table

from svsa.control.installed import check_installed, get_title, list_law_names
from svsa.errors import ParameterError, Violation
from svsa.evaluation.progress_bar import show_progress
from svsa.inputs.terminal import INTERRUPTED

_messages = Console(stderr=True)
RANKING_BUDGET, BUDGET = 2000, 128

if TYPE_CHECKING:
    from svsa.evaluation.tuning.tuner import Candidate, Tuned


def tune(
    law: Annotated[str | None, typer.Argument(help="Name of an installed law.")] = None,
    every: Annotated[
        bool, typer.Option("--all", help="Tune all installed laws for the ranking.")
    ] = False,
    budget: Annotated[
        int | None, typer.Option(min=1, help="Number of candidates; default: 128, with --all 2000.")
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

    The same command continues an interrupted search. --all skips laws that have a result with the
    same budget.
    """
    if every == (law is not None):
        raise ParameterError(Violation("law", law, "", "one law, or --all"))
    if every:
        _tune_all(budget or RANKING_BUDGET, trials, validation, seed, output)
        return
    from svsa.evaluation.campaign.journal import Journal, define_search
    from svsa.evaluation.tuning.file import describe_tuned
    from svsa.runs.definition.design_file import load_prototype, read_design

    name = check_installed(law or "")
    path = None if as_json else output or Path(f"{name}.toml")
    held = dict(map(_read_held, hold or ()))
    present = load_prototype() if parameters is None else read_design(parameters)
    started = {
        "trials": trials,
        "seed": seed,
        "held": held,
        "from": present.model_dump(mode="json"),
    }
    definition = define_search(name, **started)
    journal = Journal(path and path.with_name(path.name + ".search"), definition)
    numbers = {"budget": budget or BUDGET, "trials": trials, "validation": validation, "seed": seed}
    tuned = _search(name, held=held, present=present, journal=journal, **numbers)
    if path is None:
        typer.echo(json.dumps(describe_tuned(tuned), indent=2))
    else:
        _save(tuned, path)
    if not tuned.is_complete:
        raise typer.Exit(INTERRUPTED)
    journal.remove()


def _tune_all(budget: int, trials: int, validation: int, seed: int, output: Path | None) -> None:
    """Tune every installed law in turn, with a checkpoint each."""
    from svsa.evaluation.campaign.journal import Journal
    from svsa.evaluation.tuning.tuned_law import (
        FOLDER,
        build_tuned_law,
        list_tuned_laws,
        write_tuned_law,
    )

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
        folder.mkdir(parents=True, exist_ok=True)
        journal = Journal(folder / f"{law}.{budget}-{trials}-{seed}.jsonl")
        numbers = {"budget": budget, "trials": trials, "validation": validation, "seed": seed}
        tuned = _search(law, journal=journal, **numbers)
        if not tuned.is_complete:
            raise typer.Exit(INTERRUPTED)
        write_tuned_law(folder, build_tuned_law(tuned))
        journal.remove()
        before, after = tuned.finals[0].judgment, tuned.best.judgment
        _messages.print(
            f"{get_title(law)}: cost {before.cost:.3f} → {after.cost:.3f}, held {before.held} →"
            f" {after.held} of {validation}, torque variation"
            f" {after.torque_variation_nm_per_s:.0f} N·m/s",
            highlight=False,
        )


def _search(law: str, budget: int, **arguments: Any) -> "Tuned":
    """Continue or begin a search, with its progress on a bar."""
    from svsa.evaluation.tuning.tuner import tune

    title, best = get_title(law), float("inf")
    with show_progress(_messages, title, budget, "candidates") as report:

        def note(candidate: "Candidate") -> None:
            nonlocal best
            best = min(best, candidate.judgment.cost)
            report(candidate.number, f"{title}: best {best:.4g}")

        return tune(law, budget=budget, on_candidate=note, **arguments)


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
