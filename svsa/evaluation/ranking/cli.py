"""`svsa ranking`: the laws against each other."""

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.progress import Progress, SpinnerColumn, TimeElapsedColumn
from rich.table import Table

from svsa.control.installed import check_installed, list_law_names
from svsa.errors import ParameterError, Violation
from svsa.evaluation.ranking.bench_runs import load_published_bench_runs
from svsa.evaluation.ranking.results import (
    Results,
    load_published,
    measure_laws,
    read_results,
    write_results,
)
from svsa.evaluation.ranking.table import SHORT, build_short_cells, format_markdown
from svsa.evaluation.ranking.trials import PUBLIC_SEED, derive_seed
from svsa.inputs.extras import require_extra

ranking = typer.Typer(no_args_is_help=True, help="Every law on the same plant, limits and loads.")
_messages = Console(stderr=True)
MIN_WIDTH = 118
"""Columns of characters in which the table's numbers stand whole."""


@ranking.command("run")
def run_ranking(
    laws: Annotated[
        list[str] | None, typer.Argument(help="Names of laws; all that are installed if left out.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    markdown: Annotated[bool, typer.Option("--markdown", help="Print Markdown.")] = False,
    picture: Annotated[Path | None, typer.Option(help="Draw it into this file.")] = None,
    save: Annotated[
        Path | None,
        typer.Option(
            help="Keep every number in this file; of laws that are named, beside the others there."
        ),
    ] = None,
    results: Annotated[
        Path | None, typer.Option(help="Show what was kept there, and measure nothing.")
    ] = None,
    secret: Annotated[
        Path | None, typer.Option(help="Trials of the season whose secret is in this file.")
    ] = None,
) -> None:
    """Run laws through the scenarios and print the table: position errors in degrees."""
    if picture is not None:
        require_extra("plot")
    kept = read_results(save) if save is not None and laws and save.exists() else None
    if results is None:
        names = [check_installed(name) for name in laws or list_law_names()]
        seed = _read_seed(secret)
        if kept is not None:
            kept.renew(Results.build((), seed))
        found = _measure(names, seed)
    else:
        shown = read_results(results)
        rows = [shown.get_row(law) for law in laws] if laws else shown.rows
        found = shown.changed(rows=tuple(rows))
    if save is not None:
        write_results(save, kept.renew(found) if kept else found)
    if picture is not None:
        from svsa.evaluation.ranking.picture import save_comparison

        save_comparison(found, picture)
    if as_json:
        print(json.dumps({"laws": [row.to_json() for row in found.rows]}, indent=2))
    elif markdown:
        print(format_markdown(found.rows))
    else:
        screen = Console()
        Console(width=max(screen.width, MIN_WIDTH)).print(_build_table(found))


@ranking.command("seed")
def print_seed(
    secret: Annotated[Path, typer.Argument(help="File with the season's secret.")],
) -> None:
    """Print the seed of a season's trials: HMAC-SHA256 of its secret and the suite's version."""
    print(f"{_read_seed(secret):016x}")


@ranking.command("publish")
def publish_ranking(
    tree: Annotated[Path, typer.Argument(help="The project's source tree.")] = Path(),
) -> None:
    """Write the laws' pages with their pictures, and the README's table, from the results."""
    require_extra("plot")
    from svsa.evaluation.ranking.publish import publish

    publish(tree, load_published(), load_published_bench_runs())


def _read_seed(secret: Path | None) -> int:
    if secret is None:
        return PUBLIC_SEED
    try:
        found = secret.read_bytes().strip()
    except OSError as error:
        raise ParameterError(
            Violation("secret", str(secret), "", f"a file to be read ({error.strerror})")
        ) from None
    if not found:
        raise ParameterError(Violation("secret", str(secret), "", "a file that is not empty"))
    return derive_seed(found)


def _measure(names: list[str], seed: int) -> Results:
    columns = (SpinnerColumn(), *Progress.get_default_columns(), TimeElapsedColumn())
    with Progress(*columns, console=_messages, transient=True) as bar:
        many = f"{len(names)} laws" if len(names) > 1 else "1 law"
        task = bar.add_task(f"{many}, about 370 runs each", total=1.0)
        return measure_laws(names, seed, lambda done: bar.update(task, completed=done))


def _build_table(results: Results) -> Table:
    trials = "the public seed" if results.is_public else f"seed {results.seed}"
    table = Table(
        box=SIMPLE_HEAD,
        padding=(0, 1, 0, 0),
        title=f"Position errors [°]: suite {results.suite}, trials of {trials}",
        title_justify="left",
        caption="ideal, peak, settled, recov.: Figure 4A ideal, and on the rig (s). Score: 0.5"
        " robustness + 0.3 trials held + 0.2 accuracy. Of 48, worst: load removals that end in a"
        " fault, and rms 3–5 s after the worst. Fails, of 100: a fault, or above 1° in the last"
        " second. Step: largest on the link, N·m. --markdown names the faults.",
        caption_justify="left",
    )
    for number, heading in enumerate(SHORT):
        table.add_column(heading, justify="right" if number else "left", no_wrap=True)
    for row in results.rows:
        table.add_row(*build_short_cells(row))
    return table
