"""`svsa ranking`: control laws compared on the same plant, limits and loads."""

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from svsa.actuators.installed import get_mechanism
from svsa.actuators.parameters import SVSA
from svsa.errors import ParameterError, Violation
from svsa.evaluation.actuator_scale import REFERENCE_NM_PER_RAD, measure_scale, scale_stiffness
from svsa.evaluation.campaign.results_file import write_results_file
from svsa.evaluation.progress_bar import show_progress
from svsa.evaluation.ranking.bench_runs import load_published_bench_runs
from svsa.evaluation.ranking.entry import build_entry, get_entry_title, list_entry_keys
from svsa.evaluation.ranking.measure import TRIALS
from svsa.evaluation.ranking.results import Results, load_published, measure_entries, read_results
from svsa.evaluation.ranking.row import Row
from svsa.evaluation.ranking.scenarios import PUBLIC_SEED
from svsa.evaluation.ranking.table import HEADINGS, build_cells, format_markdown
from svsa.evaluation.trials import PROTOCOL
from svsa.inputs.extras import require_extra

ranking = typer.Typer(
    no_args_is_help=True, help="Compare all laws with the same plant, limits and loads."
)
_messages = Console(stderr=True)
MIN_WIDTH = 150
"""Width of the terminal, in characters, that the table needs."""


@ranking.command("run")
def run_ranking(
    rows: Annotated[
        list[str] | None,
        typer.Argument(help="Names of laws, or ndobc_declared; default: all installed laws."),
    ] = None,
    trials: Annotated[int, typer.Option(min=1, help="Test trials of each family.")] = TRIALS,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the test set.")] = PUBLIC_SEED,
    actuator: Annotated[
        str, typer.Option(help="Installed actuator; trials are scaled to it.")
    ] = SVSA,
    save: Annotated[
        Path | None,
        typer.Option(help="Write results to this file after each row; other rows are unchanged."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    markdown: Annotated[bool, typer.Option("--markdown", help="Print Markdown.")] = False,
) -> None:
    """Measure laws on the test set and the fixed scenarios, and print the table.

    Without names, the command skips rows that the file already has with the same protocol, seed,
    trials and parameters, so that an interrupted command continues. Gains and parameters are those
    tuned for the SVSA. For another actuator, poles and bandwidths are scaled by its default gains.
    """
    get_mechanism(actuator)  # an unknown name is rejected before anything is measured
    known = _read_known(save, seed, trials, actuator)
    keys = list(rows) if rows else list_entry_keys()
    entries = [build_entry(key, actuator) for key in keys]
    if not rows:
        tuned = {entry.key: entry.tuning for entry in entries}
        done = {row.key for row in known if row.key in tuned and row.tuning == tuned[row.key]}
        keys = [key for key in keys if key not in done]
    results = Results.build(known, seed, trials, actuator) if known else None
    with show_progress(_messages, "", len(keys), "") as bar:

        def report(key: str, done: float) -> None:
            bar(keys.index(key) + done, get_entry_title(key))

        for results in measure_entries(keys, seed, trials, known, report, actuator):
            if save is not None:
                write_results_file(save, results)
    if results is not None:
        _print(results, as_json, markdown)


@ranking.command("table")
def print_table(
    results: Annotated[
        Path | None, typer.Option(help="File of results; default: the published results.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    markdown: Annotated[bool, typer.Option("--markdown", help="Print Markdown.")] = False,
) -> None:
    """Print the table of results without measuring."""
    _print(load_published() if results is None else read_results(results), as_json, markdown)


@ranking.command("publish")
def publish_ranking(
    tree: Annotated[Path, typer.Argument(help="The project's source tree.")] = Path(),
) -> None:
    """Write the pages of the laws, their index and pictures from the results."""
    require_extra("plot")
    from svsa.evaluation.ranking.publish import publish

    publish(tree, load_published(), load_published_bench_runs())


def _read_known(save: Path | None, seed: int, trials: int, actuator: str) -> tuple[Row, ...]:
    """Read the rows of a file that were measured with the same protocol, seed, trials and actuator.

    Raises:
        ParameterError: If the file is of another actuator, and would be overwritten.
    """
    if save is None or not save.exists():
        return ()
    results = read_results(save)
    if results.actuator != actuator:
        bound = f"a file of its own: this one has the actuator {results.actuator}"
        raise ParameterError(Violation("--save", save, "", bound))
    is_same = (results.protocol, results.seed, results.trials) == (PROTOCOL, seed, trials)
    return results.rows if is_same else ()


def _print(results: Results, as_json: bool, markdown: bool) -> None:
    if as_json:
        print(json.dumps(results.model_dump(mode="json"), indent=1))
    elif markdown:
        print(format_markdown(results))
    else:
        screen = Console()
        Console(width=max(screen.width, MIN_WIDTH)).print(_build_table(results))


def _describe_scale(actuator: str) -> str:
    """Describe how scenarios of the SVSA were scaled to another actuator; empty for the SVSA."""
    if actuator == SVSA:
        return ""
    scale = measure_scale(actuator)
    sigma = scale_stiffness(get_mechanism(actuator), REFERENCE_NM_PER_RAD)
    return (
        f" Scaled from the SVSA: loads × {scale.torque:g}, {REFERENCE_NM_PER_RAD:g} N·m/rad →"
        f" {sigma:g} N·m/rad. Parameters are those tuned for the SVSA, with poles and bandwidths"
        " scaled by the default gains of the actuator."
    )


def _build_table(results: Results) -> Table:
    table = Table(
        box=SIMPLE_HEAD,
        padding=(0, 1, 0, 0),
        title=f"{get_mechanism(results.actuator).title}: share of {results.trials} trials of each"
        f" family that held, %: protocol {results.protocol}, seed {results.seed}",
        title_justify="left",
        caption=f"Held: {results.criterion}. Fixed scenarios at both signs and 8 phases."
        f"{_describe_scale(results.actuator)}",
        caption_justify="left",
    )
    for number, heading in enumerate(HEADINGS):
        table.add_column(heading, justify="left" if number == 1 else "right")
    for row in results.rows:
        table.add_row(*build_cells(results, row))
    return table
