"""`svsa tune`: search a law's parameters, and write them where they can be used."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from svsa.control.installed import check_installed, get_title
from svsa.errors import ParameterError, Violation

INTERRUPTED = 130

if TYPE_CHECKING:
    from svsa.evaluation.tuning.tuner import Trial, Tuned


def tune(
    law: Annotated[str, typer.Argument(help="Name of a law that is installed.")],
    budget: Annotated[int, typer.Option(min=1, help="Candidates to be tried.")] = 124,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the Sobol points.")] = 0,
    hold: Annotated[
        list[str] | None,
        typer.Option(help="NAME=VALUE: a parameter that is set and not searched."),
    ] = None,
    parameters: Annotated[
        Path | None, typer.Option(help="Parameter file to begin from (TOML).")
    ] = None,
    output: Annotated[
        Path | None, typer.Option(help="Parameter file to write; LAW.toml if left out.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print everything that was tried as JSON, write no file.")
    ] = False,
) -> None:
    """Tune a law on the five training runs. Ctrl-C ends the search and keeps the best so far."""
    from svsa.evaluation.tuning.file import describe_tuned
    from svsa.evaluation.tuning.tuner import tune as search
    from svsa.runs.configuration import read_design

    check_installed(law)
    with Progress(
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn(),
        console=Console(stderr=True), transient=True,
    ) as bar:  # fmt: skip
        task = bar.add_task(f"{get_title(law)}: compiling", total=budget)
        best = float("inf")

        def follow(trial: "Trial") -> None:
            nonlocal best
            best = min(best, trial.cost)
            reported = f"{get_title(law)}: best {best:.4g}"
            bar.update(task, completed=trial.number, description=reported)

        tuned = search(
            law,
            budget=budget,
            seed=seed,
            held=dict(map(_read_held, hold or ())),
            present=None if parameters is None else read_design(parameters),
            on_trial=follow,
        )
    if as_json:
        typer.echo(json.dumps(describe_tuned(tuned), indent=2))
    else:
        _save(tuned, output or Path(f"{law}.toml"))
    if not tuned.is_complete:
        raise typer.Exit(INTERRUPTED)


def _save(tuned: "Tuned", path: Path) -> None:
    """Write the parameter file and print what was found."""
    from svsa.evaluation.tuning.file import format_tuned

    path.write_text(format_tuned(tuned), encoding="utf-8")
    console = Console()
    console.print(_build_value_table(tuned), _build_cost_table(tuned), highlight=False)
    if not tuned.is_complete:
        console.print(f"Broken off after {len(tuned.trials) - 1} of {tuned.budget} candidates.")
    console.print(f"Parameter file: {path}", highlight=False)


def _read_held(text: str) -> tuple[str, float]:
    name, equals, value = text.partition("=")
    try:
        if equals:
            return name.strip(), float(value)
    except ValueError:
        pass
    raise ParameterError(Violation("hold", text, "", "NAME=VALUE, as estimate_share=0"))


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
    table = Table("training run", title="Cost", title_justify="left")
    for column in ("before", "tuned", "rms e, °", "rms eσ, N·m/rad", "shake, N·m"):
        table.add_column(column, justify="right")
    for run, old, new in zip(tuned.runs, tuned.start.runs, tuned.best.runs, strict=True):
        numbers = (new.position_error_deg, new.stiffness_error_nm_per_rad, new.torque_change_nm)
        reported = (f"{number:.3g}" for number in numbers)
        table.add_row(run.name, f"{old.cost:.4f}", new.fault or f"{new.cost:.4f}", *reported)
    table.add_row("mean", f"{tuned.start.cost:.4f}", f"{tuned.best.cost:.4f}")
    return table
