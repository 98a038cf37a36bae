"""`svsa ranking against`: a law beside a comparison, on runs that the table has not."""

import json
from typing import Annotated

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from svsa.control.installed import PAPERS_LAW, check_installed, get_title
from svsa.evaluation.ranking.against import Standing, compare
from svsa.evaluation.ranking.measure import Entry


def against(
    law: Annotated[str, typer.Argument(help="Name of a law that is installed.")],
    comparison: Annotated[str, typer.Option(help="Name of the law beside it.")] = PAPERS_LAW,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Compare two laws column by column on the rehearsal: runs that are not in the table."""
    check_installed(law)
    check_installed(comparison)
    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(f"{get_title(law)} and {get_title(comparison)}", total=1.0)
        standings = compare(
            Entry(law), Entry(comparison), report=lambda done: bar.update(task, completed=done)
        )
    if as_json:
        typer.echo(json.dumps({"contests": [_to_json(one) for one in standings]}, indent=2))
    else:
        Console().print(_build_table(law, comparison, standings))


def _to_json(standing: Standing) -> dict[str, str | float | bool | None]:
    law, comparison = (
        None if value == float("inf") else value for value in (standing.law, standing.comparison)
    )
    return {
        "title": standing.contest.title,
        "unit": standing.contest.unit,
        "law": law,
        "comparison": comparison,
        "is_no_worse": standing.is_no_worse,
    }


def _build_table(law: str, comparison: str, standings: tuple[Standing, ...]) -> Table:
    better = sum(one.is_no_worse for one in standings)
    table = Table(
        box=SIMPLE_HEAD,
        title=f"{get_title(law)} is no worse in {better} of {len(standings)}",
        title_justify="left",
    )
    for heading in ("On the rehearsal", get_title(law), get_title(comparison), "ratio"):
        table.add_column(heading, justify="left" if heading == "On the rehearsal" else "right")
    for one in standings:
        table.add_row(
            one.contest.title,
            *(_tell(value, one.contest.unit) for value in (one.law, one.comparison)),
            f"{one.law / one.comparison:.2f}" if 0.0 < one.comparison < float("inf") else "",
        )
    return table


def _tell(value: float, unit: str) -> str:
    if value == float("inf"):
        return "fault"
    return f"{value:.3g}{' ' + unit if unit == 's' else unit}"
