"""`svsa falsify`: find the load that degrades a law most, save it, run other laws under it."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from svsa.control.installed import PAPERS_LAW, get_title, list_law_names
from svsa.evaluation.progress_bar import Report, show_progress
from svsa.inputs.output_file import check_picture, check_writable
from svsa.inputs.terminal import INTERRUPTED

if TYPE_CHECKING:
    from svsa.evaluation.falsifier.adversary import Adversary
    from svsa.evaluation.falsifier.falsification import Falsified
    from svsa.evaluation.falsifier.measure import LawOutcome
    from svsa.evaluation.falsifier.scenario import LoadScenario

falsify = typer.Typer(
    no_args_is_help=True, help="Search for the worst load of a law, and simplify it."
)
_messages = Console(stderr=True)
_Adversary = Annotated[
    str, typer.Argument(metavar="ADVERSARY", help="A file (.toml), or a built-in adversary.")
]
_Runs = Annotated[int, typer.Option(min=1, max=1_000_000, help="Maximum number of runs.")]
_Law = Annotated[
    str | None, typer.Option(help="Law under test; default: the law of the adversary.")
]
_Picture = Annotated[Path | None, typer.Option(help="Draw the picture into this file.")]
_Json = Annotated[bool, typer.Option("--json", help="Print JSON.")]


@falsify.command("search")
def search_command(
    source: _Adversary,
    law: _Law = None,
    runs: _Runs = 20_000,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the search.")] = 0,
    output: Annotated[
        Path | None, typer.Option(help="Scenario file to write; default: ADVERSARY-LAW.toml.")
    ] = None,
    picture: _Picture = None,
    as_json: _Json = False,
) -> None:
    """Search for the worst load, simplify it and save it. Ctrl-C saves the worst so far."""
    from svsa.evaluation.falsifier.falsification import falsify as find
    from svsa.evaluation.falsifier.file import open_search, read_adversary, write_scenario
    from svsa.evaluation.falsifier.measure import list_baselines

    check_picture("--picture", picture)
    adversary = read_adversary(source, **({} if law is None else {"law": law}))
    path = output or Path(f"{Path(source).stem}-{adversary.law}.toml")
    check_writable("--output", path)
    journal = open_search(path, adversary, seed, "cma")
    with show_progress(_messages, get_title(adversary.law), runs) as report:
        on_generation = _report_worst(adversary, report)
        falsified = find(
            adversary, runs=runs, seed=seed, on_generation=on_generation, journal=journal
        )
    scenario = falsified.scenario
    write_scenario(path, scenario)
    if not as_json:
        _print_found(falsified)
    described = _describe(falsified, path) if as_json else None
    _compare_laws(scenario, list_baselines(adversary.law), described, picture)
    _messages.print(f"Saved as {path}. Other laws: svsa falsify run {path} --laws all")
    if not falsified.is_complete:
        _messages.print(
            f"Interrupted after {len(falsified.severities)} of {runs} runs, not simplified. The"
            " same command continues the search."
        )
        raise typer.Exit(INTERRUPTED)
    journal.remove()


@falsify.command("run")
def run_command(
    source: Annotated[
        str,
        typer.Argument(metavar="SCENARIO", help="A file (.toml), or the name of a saved scenario."),
    ],
    laws: Annotated[
        str | None,
        typer.Option(help="Names separated by commas, or all; default: the law of the search."),
    ] = None,
    picture: _Picture = None,
    as_json: _Json = False,
) -> None:
    """Run laws in a saved scenario."""
    from svsa.evaluation.falsifier.description import describe_neighborhood
    from svsa.evaluation.falsifier.file import open_scenario
    from svsa.evaluation.falsifier.measure import list_baselines

    check_picture("--picture", picture)
    scenario = open_scenario(source)
    if laws is None:
        names = list_baselines(scenario.found.law if scenario.found else PAPERS_LAW)
    else:
        names = list_law_names() if laws == "all" else tuple(map(str.strip, laws.split(",")))
    if not as_json:
        neighborhood = describe_neighborhood(scenario.found)
        Console(highlight=False).print(f"{scenario.title}\n{neighborhood}".strip())
    _compare_laws(scenario, names, {"scenario": scenario.title} if as_json else None, picture)


@falsify.command("list")
def list_command() -> None:
    """List the built-in adversaries."""
    from svsa.evaluation.falsifier.file import list_adversaries, read_adversary

    table = Table("adversary", "what it may do", "after", "numbers", title_justify="left")
    for name, title in list_adversaries().items():
        adversary = read_adversary(name)
        table.add_row(name, title, adversary.cost, str(adversary.size))
    Console().print(table)


@falsify.command("compare")
def compare_command(
    source: _Adversary,
    law: _Law = None,
    runs: _Runs = 20_000,
    seeds: Annotated[int, typer.Option(min=1, max=1000, help="Number of seeds: 0, 1, …")] = 10,
    as_json: _Json = False,
) -> None:
    """Compare the search with random samples: the run of the first fault for each seed."""
    from svsa.evaluation.falsifier.comparison import compare_methods
    from svsa.evaluation.falsifier.description import format_severity
    from svsa.evaluation.falsifier.file import read_adversary
    from svsa.evaluation.studies.tables import write_json

    adversary = read_adversary(source, **({} if law is None else {"law": law}))
    with show_progress(_messages, get_title(adversary.law), 2 * runs * seeds) as report:
        compared = compare_methods(adversary, runs, range(seeds), _report_worst(adversary, report))
    if as_json:
        write_json(compared)
        return
    table = Table("seed", "CMA-ES", "random", title=adversary.title, title_justify="left")
    for seed_result in compared.results:
        cells = [
            f"fault at run {run}"
            if run
            else f"none in {runs}: {format_severity(adversary.cost, x)}"
            for run, x in (
                (seed_result.cma_run, seed_result.cma_worst),
                (seed_result.random_run, seed_result.random_worst),
            )
        ]
        table.add_row(str(seed_result.seed), *cells)
    Console().print(table)
    Console().print(compared.message)


def _compare_laws(
    scenario: "LoadScenario",
    laws: tuple[str, ...],
    described: dict[str, object] | None,
    picture: Path | None,
) -> None:
    """Run laws in a scenario and print the results; draw them if there is a picture.

    `described` is added to the JSON output; None prints a table instead.
    """
    from svsa.evaluation.falsifier.measure import run_scenario
    from svsa.evaluation.studies.tables import write_json

    compared = run_scenario(scenario, laws)
    if described is None:
        Console().print(_build_table(compared))
    else:
        write_json(described | {"laws": [outcome._asdict() for outcome in compared]})
    if picture is not None:
        from svsa.evaluation.falsifier.picture import save_picture

        save_picture(scenario, laws, picture)
        _messages.print(f"Picture: {picture}", highlight=False)


def _describe(falsified: "Falsified", path: Path) -> dict[str, object]:
    simple = falsified.shrunk
    return {
        "adversary": falsified.adversary.title,
        "law": falsified.adversary.law,
        "cost": falsified.adversary.cost,
        "seed": falsified.seed,
        "runs": len(falsified.severities),
        "run": falsified.run,
        "complete": falsified.is_complete,
        "fault": falsified.is_fault,
        "outcome": falsified.outcome,
        "shrinking": None if simple is None else {"runs": simple.runs, "steps": simple.steps},
        "neighborhood": falsified.neighborhood and falsified.neighborhood._asdict(),
        "scenario": falsified.scenario.model_dump(mode="json", exclude_none=True),
        "file": str(path),
    }


def _print_found(falsified: "Falsified") -> None:
    from svsa.evaluation.falsifier.description import (
        describe_attack,
        describe_neighborhood,
        format_severity,
    )

    console, a = Console(highlight=False), falsified.adversary
    nothing = format_severity(a.cost, falsified.nothing)
    console.print(f"{get_title(a.law)} without it: {nothing}")
    console.print(
        f"Found at run {falsified.run} of {len(falsified.severities)}: {falsified.outcome}"
    )
    console.print(f"  {describe_attack(falsified.attack)}")
    if falsified.shrunk is not None:
        simple = falsified.shrunk
        console.print(f"Simplified by {simple.runs} runs: {simple.outcome}")
        console.print(f"  {describe_attack(simple.attack)}")
        console.print(describe_neighborhood(falsified.scenario.found))


def _build_table(compared: "list[LawOutcome]") -> Table:
    """The outcome of each law; metrics of a run with a fault end at the fault."""
    from svsa.actuators.faults import label_fault
    from svsa.evaluation.studies.tables import format_unit, format_value

    names = {
        "peak_position_error_rad": "peak",
        "steady_state_position_error_rad": "settled",
        "recovery_time_s": "recovery",
        "peak_stiffness_error_nm_per_rad": "peak of σ",
    }
    table = Table("law", "ends", title="Position error and stiffness error", title_justify="left")
    for name, title in names.items():
        heading = escape(f"{title}\n[{format_unit(name)}]")
        table.add_column(heading, justify="right", no_wrap=True)
    for outcome in compared:
        end = (
            "whole"
            if outcome.fault is None
            else f"{label_fault(outcome.fault)}, {outcome.fault_s:.3f} s"
        )
        cells = [format_value(name, outcome.metrics[name]) for name in names]
        table.add_row(get_title(outcome.law), end, *cells)
    return table


def _report_worst(adversary: "Adversary", report: Report) -> "Callable[[int, float], None]":
    """A progress function that shows the worst run so far."""
    from svsa.evaluation.falsifier.description import describe_worst

    title = get_title(adversary.law)
    return lambda done, worst: report(done, f"{title}: {describe_worst(adversary.cost, worst)}")
