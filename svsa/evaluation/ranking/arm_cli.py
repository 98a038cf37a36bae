"""`svsa ranking arm`: controllers of an arm, each tuned with the same budget."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from svsa.errors import ParameterError, Violation
from svsa.evaluation.campaign.results_file import read_results_file, write_results_file
from svsa.evaluation.progress_bar import show_progress
from svsa.inputs.output_file import check_writable

if TYPE_CHECKING:
    from svsa.evaluation.ranking.arm import ArmProtocol, ArmResults, ArmRow
    from svsa.evaluation.tuning.arm import ArmController

MIN_WIDTH = 150
"""Width of the terminal, in characters, that the table needs."""


def rank_arm(
    rows: Annotated[
        list[str] | None,
        typer.Argument(help="Controllers, such as fl, fl+ff, pd+adaptive; default: all."),
    ] = None,
    budget: Annotated[int, typer.Option(min=1, help="Number of candidates of each search.")] = 128,
    training: Annotated[int, typer.Option(min=1, help="Training trials of each candidate.")] = 24,
    validation: Annotated[
        int, typer.Option(min=1, help="Validation trials of the best ten candidates.")
    ] = 48,
    trials: Annotated[int, typer.Option(min=1, help="Test trials.")] = 96,
    seed: Annotated[int, typer.Option(min=0, help="Seed of searches and trials.")] = 0,
    arm: Annotated[str, typer.Option(help="Name of the arm.")] = "rods",
    save: Annotated[
        Path | None,
        typer.Option(help="Write results to this file after each row; other rows are unchanged."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    markdown: Annotated[bool, typer.Option("--markdown", help="Print Markdown.")] = False,
) -> None:
    """Tune the controllers of an arm, and compare them on test trials.

    Without names, the command skips rows that the file already has with the same protocol, so that
    an interrupted command continues.
    """
    from svsa.evaluation.ranking.arm import (
        ArmProtocol,
        format_arm_markdown,
        list_arm_controllers,
        measure_arm_rows,
        order_arm_rows,
    )

    protocol = ArmProtocol(
        budget=budget, training=training, validation=validation, trials=trials, seed=seed, arm=arm
    )
    offered = {controller.key: controller for controller in list_arm_controllers()}
    for key in rows or ():
        if key not in offered:
            raise ParameterError(Violation("row", key, "", "one of " + ", ".join(offered)))
    if save is not None:
        check_writable("--save", save)
    known = _read_known(save, protocol)
    done = () if rows else [row.controller for row in known]
    chosen = [offered[key] for key in rows or offered if offered[key] not in done]
    results = order_arm_rows(known, protocol)
    with show_progress(Console(stderr=True), "", len(chosen), "") as bar:

        def report(controller: "ArmController", share: float) -> None:
            bar(chosen.index(controller) + share, controller.title)

        for results in measure_arm_rows(chosen, protocol, known, report):
            if save is not None:
                write_results_file(save, results)
    if as_json:
        typer.echo(results.model_dump_json(indent=1))
    elif markdown:
        typer.echo(format_arm_markdown(results))
    else:
        screen = Console()
        Console(width=max(screen.width, MIN_WIDTH)).print(_build_table(results), highlight=False)


def _read_known(save: Path | None, protocol: "ArmProtocol") -> "tuple[ArmRow, ...]":
    """Read the rows of a file that were measured with the same protocol."""
    from svsa.evaluation.ranking.arm import ArmResults

    if save is None or not save.exists():
        return ()
    kept = read_results_file(ArmResults, save, "svsa ranking arm --save", "--save")
    return kept.rows if kept.protocol == protocol else ()


def _build_table(results: "ArmResults") -> Table:
    from svsa.evaluation.metrics import HELD
    from svsa.evaluation.ranking.arm import INFEASIBLE, list_arm_cells, list_arm_headings

    p = results.protocol
    title = (
        f"Controllers of the arm {p.arm}: {p.budget} candidates on {p.training} trials each,"
        f" tested on {p.trials}, seed {p.seed}"
    )
    table = Table(
        box=SIMPLE_HEAD,
        padding=(0, 1, 0, 0),
        title=title,
        title_justify="left",
        caption=f"Held: {HELD}, of all joints.{INFEASIBLE}: no parameters below the noise limit.",
        caption_justify="left",
    )
    for number, heading in enumerate(list_arm_headings(results)):
        table.add_column(heading, justify="left" if number == 1 else "right")
    for cells in list_arm_cells(results):
        table.add_row(*cells)
    return table
