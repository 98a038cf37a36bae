"""`svsa identify`: from a recorded run or a CSV file to a parameter file."""

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
    run: Annotated[
        str,
        typer.Argument(
            metavar="RUN",
            help="Id of a recorded run, folder of a record, or a CSV file.",
        ),
    ],
    output: Annotated[Path, typer.Option(help="Parameter file to write.")] = Path(
        "identified.toml"
    ),
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the numbers as JSON, and write no file.")
    ] = False,
    stiffness: Annotated[
        float | None,
        typer.Option(
            help="For a CSV file: stiffness in its first row, without deflection, N·m/rad."
        ),
    ] = None,
    parameters: Annotated[
        Path | None,
        typer.Option(help="For a CSV file: parameter file with the known radius R and γ."),
    ] = None,
) -> None:
    """Estimate inertias, dampings, spring and friction from a recorded run or a CSV file.

    The CSV file has the columns time_s, motor1_position_rad, motor2_position_rad, deflection_rad
    (or _deg each), torque1_nm and torque2_nm, measured without a load in equal steps.
    """
    from svsa.analysis.identification.measured import identify as identify_measured
    from svsa.runs.definition.design_file import write_design
    from svsa.runs.records.header import describe_newer
    from svsa.runs.result.recorded import find_record

    is_csv = run.lower().endswith(".csv")
    if not is_csv and (newer := describe_newer(find_record(run).header.version)):
        Console(stderr=True).print(f"Note: {newer}", highlight=False, markup=False)
    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("Identifying", total=1.0)
        identified = identify_measured(
            run,
            parameters=parameters,
            stiffness_nm_per_rad=stiffness,
            progress=lambda done: bar.update(task, completed=done),
        )
    if as_json:
        typer.echo(json.dumps(identified.to_json(), indent=2))
        return
    console = Console()
    console.print(_build_table(identified), highlight=False)
    console.print(_summarize(identified), highlight=False)
    design = identified.build_design()
    source = f"run {identified.run_id}: actuator and nominal identified, the rest as in the run"
    write_design(output, design, source)
    console.print(f"Parameter file: {output}", highlight=False)


def _build_table(identified: "Identification") -> Table:
    table = Table("", title=f"Run {identified.run_id}", title_justify="left")
    for column in ("estimate", "95 % interval", "±", "unit"):
        table.add_column(column, justify="left" if column == "unit" else "right")
    for name, estimate in identified.estimates.items():
        interval = f"{estimate.low:.5g} … {estimate.high:.5g}", f"{estimate.relative_width:.2%}"
        if name in identified.undetermined:
            interval = "not determined", ""
        elif estimate.relative_width > 1.0:
            interval = interval[0], ""
        table.add_row(estimate.symbol, f"{estimate.value:.5g}", *interval, estimate.unit)
    return table


def _summarize(identified: "Identification") -> str:
    theta1, theta2, phi = (1e6 * value for value in identified.residual_rad)
    return (
        f"Used: {identified.used_s:g} s; under a load: {identified.loaded_s:g} s; not explained:"
        f" {identified.dropped_s:g} s. Residual of θ1, θ2, φ: {theta1:.0f}, {theta2:.0f}, {phi:.0f}"
        f" µrad, {identified.misfit:.1f} times the noise of the sensors."
    )
