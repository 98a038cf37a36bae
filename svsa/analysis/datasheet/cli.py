"""`svsa datasheet`: the capabilities of an actuator as a table, JSON or a page (PDF or PNG)."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.table import Table

from svsa.inputs.output_file import check_picture

if TYPE_CHECKING:
    from svsa.analysis.datasheet.measure import Datasheet


def datasheet(
    name: Annotated[str, typer.Argument(help="Installed actuator, such as qbmove.")],
    plot: Annotated[Path | None, typer.Option(help="Picture file (.png, .pdf, .svg).")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the numbers as JSON.")] = False,
) -> None:
    """Measure the datasheet of an actuator on its simulation (Grioli et al., IJRR 2015)."""
    from svsa.analysis.datasheet.measure import measure_datasheet

    check_picture("--plot", plot)
    sheet = measure_datasheet(name)
    if plot is not None:
        from svsa.analysis.datasheet.page import draw_page

        draw_page(sheet).savefig(plot)
    if as_json:
        typer.echo(json.dumps(sheet.model_dump(mode="json")))
        return
    Console().print(*_build_tables(sheet), highlight=False)


def _build_tables(sheet: "Datasheet") -> list[Table]:
    from svsa.analysis.datasheet.rows import (
        PUBLISHED_HEADS,
        list_published,
        list_rows,
        write_figure,
    )

    summary = Table(title=f"{sheet.title} ({sheet.source})", title_justify="left")
    summary.add_column("Quantity")
    summary.add_column("Simulated plant", justify="right")
    for row in list_rows(sheet):
        summary.add_row(*row)
    published = Table(title="Published figures", title_justify="left")
    for head in PUBLISHED_HEADS:
        published.add_column(head)
    for compared in list_published(sheet) or [("none with a source is known", "", "", "", "")]:
        published.add_row(*compared)
    presets = Table(title="Stiffness presets, motors at rest", title_justify="left")
    for column in ("σ at φ = 0 [N·m/rad]", "Deflection [rad]", "Torque [N·m]", "Energy [J]"):
        presets.add_column(column, justify="right")
    for preset in sheet.presets:
        numbers = (
            preset.stiffness_nm_per_rad,
            preset.deflection_rad[-1],
            preset.torque_nm[-1],
            preset.energy_j,
        )
        presets.add_row(*map(write_figure, numbers))
    assumed = Table(title="Parameters without a published source", title_justify="left")
    assumed.add_column("Name")
    for name in sheet.assumed:
        assumed.add_row(name)
    return [summary, published, presets, assumed]
