"""`svsa arena`: the laws against each other."""

import json
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from svsa.arena.measure import Entry, measure_law
from svsa.arena.table import HEADINGS, build_cells, format_markdown
from svsa.control.installed import check_installed, get_title, list_law_names

arena = typer.Typer(no_args_is_help=True, help="Every law on the same plant, limits and loads.")
_messages = Console(stderr=True)


@arena.command("run")
def run_arena(
    laws: Annotated[
        list[str] | None, typer.Argument(help="Names of laws; all that are installed if left out.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    markdown: Annotated[bool, typer.Option("--markdown", help="Print Markdown.")] = False,
) -> None:
    """Run laws through the scenarios and print the table: position errors in degrees."""
    names = [check_installed(name) for name in laws or list_law_names()]
    rows = []
    with Progress(console=_messages, transient=True) as bar:
        for name in names:
            task = bar.add_task(get_title(name), total=1.0)
            rows.append(
                measure_law(Entry(name), lambda done, t=task: bar.update(t, completed=done))
            )
    if as_json:
        print(json.dumps({"laws": [row.to_json() for row in rows]}, indent=2))
    elif markdown:
        print(format_markdown(rows))
    else:
        table = Table(*HEADINGS, title="Position errors [°]", title_justify="left")
        for row in rows:
            table.add_row(*build_cells(row))
        Console().print(table)
