"""`svsa identify`: from a recorded run to a parameter file."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

if TYPE_CHECKING:
    from svsa.analysis.identification.identify import Identification


def identify(
    run: Annotated[str, typer.Argument(help="Id of a run in the catalogue, or a record's folder.")],
    output: Annotated[Path, typer.Option(help="Parameter file to write.")] = Path(
        "identified.toml"
    ),
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the numbers as JSON, write no file.")
    ] = False,
) -> None:
    """Estimate inertias, dampings, spring and friction from a recorded run."""
    from svsa.analysis.identification import identify as identification
    from svsa.runs.configuration import write_design
    from svsa.runs.records.header import describe_newer
    from svsa.runs.result.recorded import find_record

    record = find_record(run)
    if newer := describe_newer(record.header.version):
        Console(stderr=True).print(f"Note: {newer}", highlight=False, markup=False)
    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("Identifying", total=1.0)
        found = identification.identify(record, lambda done: bar.update(task, completed=done))
    if as_json:
        typer.echo(json.dumps(found.to_json(), indent=2))
        return
    console = Console()
    console.print(_build_table(found), highlight=False)
    console.print(_summarize(found), highlight=False)
    design = found.build_design()
    source = f"run {found.run_id}: actuator and nominal identified, the rest as in the run"
    write_design(output, design, source)
    console.print(f"Parameter file: {output}", highlight=False)


def _build_table(found: "Identification") -> Table:
    table = Table("", title=f"Run {found.run_id}", title_justify="left")
    for column in ("estimate", "95 % interval", "±", "unit"):
        table.add_column(column, justify="left" if column == "unit" else "right")
    for name, estimate in found.estimates.items():
        interval = f"{estimate.low:.5g} … {estimate.high:.5g}", f"{estimate.relative_width:.2%}"
        if name in found.undetermined:
            interval = "not determined", ""
        elif estimate.relative_width > 1.0:
            interval = interval[0], ""
        table.add_row(estimate.symbol, f"{estimate.value:.5g}", *interval, estimate.unit)
    return table


def _summarize(found: "Identification") -> str:
    theta1, theta2, phi = (1e6 * value for value in found.residual_rad)
    return (
        f"Used: {found.used_s:g} s; under a load: {found.loaded_s:g} s; not explained:"
        f" {found.dropped_s:g} s. Left of θ1, θ2, φ: {theta1:.0f}, {theta2:.0f}, {phi:.0f} µrad,"
        f" {found.misfit:.1f} times the noise of the sensors."
    )
