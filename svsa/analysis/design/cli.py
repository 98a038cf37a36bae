"""`svsa stability`: Theorem 1 in tables, as JSON and as a picture; `svsa margins`: of all laws."""

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from svsa.inputs.output_file import check_picture

if TYPE_CHECKING:
    from svsa.analysis.design.attraction import Cell, StartOutcome
    from svsa.analysis.design.report import Report
    from svsa.analysis.design.robustness import StableRange


def stability(
    law: Annotated[str, typer.Option(help="Name of an installed law.")] = "ndobc",
    stiffness: Annotated[
        list[float] | None, typer.Option(help="σ_d, N·m/rad; repeatable; default: 15 and 60.")
    ] = None,
    pole: Annotated[
        float | None,
        typer.Option(help="FL and NDOBC: place all four position poles at −POLE, rad/s."),
    ] = None,
    observer: Annotated[
        float | None, typer.Option(help="Observer bandwidth β on all channels, rad/s.")
    ] = None,
    parameters: Annotated[Path | None, typer.Option(help="Parameter file (TOML).")] = None,
    starts: Annotated[
        int,
        typer.Option(min=0, max=101, help="Initial states along each axis of the map; 0: no map."),
    ] = 41,
    plot: Annotated[Path | None, typer.Option(help="Picture file (.png, .pdf, .svg).")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the numbers as JSON.")] = False,
) -> None:
    """Show the stability of a law: poles, gain from ẇ to e, fastest observer, attraction."""
    from svsa.analysis.design.report import build_configuration, build_report

    check_picture("--plot", plot)
    configuration = build_configuration(law, pole, observer, parameters)
    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("Compiling, then simulating the initial states", total=1.0)
        reports = build_report(
            configuration,
            tuple(stiffness or (15.0, 60.0)),
            starts,
            lambda done: bar.update(task, completed=done),
        )
    if plot is not None:
        from svsa.analysis.design.figures import save_picture

        save_picture(configuration, reports, plot)
    if as_json:
        typer.echo(json.dumps({"law": law, "stability": [report.to_json() for report in reports]}))
        return
    Console().print(*_build_tables(reports), highlight=False)


def margins(
    laws: Annotated[
        list[str] | None, typer.Argument(help="Names of laws; default: all installed laws.")
    ] = None,
    stiffness: Annotated[
        list[float] | None, typer.Option(help="σ_d, N·m/rad; repeatable; default: 15 and 60.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the numbers as JSON.")] = False,
) -> None:
    """Show the stability margins of laws on the rig: modulus, delay, gain, joint model error."""
    from svsa.analysis.design.margin_table import (
        HEADS,
        STIFFNESSES,
        compute_law_margins,
        format_margins,
    )
    from svsa.control.installed import get_law, list_law_names

    names = tuple(laws or list_law_names())
    titles = [get_law(name).title for name in names]
    table = Table("law", "σ", *HEADS, title="Margins of the sampled loop about rest, on the rig")
    rows: list[dict[str, Any]] = []
    with Progress(console=Console(stderr=True), transient=True) as bar:
        for name, title in bar.track(list(zip(names, titles, strict=True)), description="Margins"):
            for sigma, loop_margins in compute_law_margins(name, tuple(stiffness or STIFFNESSES)):
                table.add_row(title, f"{sigma:g}", *format_margins(loop_margins))
                rows.append({"law": name, "stiffness_nm_per_rad": sigma, **loop_margins.to_json()})
    if as_json:
        typer.echo(json.dumps({"margins": rows}))
        return
    Console().print(table, highlight=False)


def _build_tables(reports: "list[Report]") -> list[Table]:
    return [_build_loop_table(reports), _build_range_table(reports)]


def _build_loop_table(reports: "list[Report]") -> Table:
    table = Table(
        "at σ, N·m/rad",
        title="The loop about rest",
        caption="Gains of the linear loop, for small motions. Starts: a sample, no proof.",
        title_justify="left",
        caption_justify="left",
    )
    rows: list[tuple[str, list[str]]] = [
        (
            "slowest real part, rad/s",
            [f"{report.stability.loop.slowest:.2f}" for report in reports],
        ),
        ("least damping", [f"{report.stability.loop.least_damping:.2f}" for report in reports]),
        (
            "e per ẇ2, ° per N·m/s",
            [_format_degrees(report.stability.gain.ramp) for report in reports],
        ),
        ("  by the formula", [_format_degrees(report.stability.formula) for report in reports]),
        ("  simulated ramps", [_format_ramps(report) for report in reports]),
        (
            "  L1 gain, linear loop",
            [_format_degrees(report.stability.gain.l1) for report in reports],
        ),
        ("  floor as β → ∞", [_format_degrees(report.stability.floor) for report in reports]),
        ("|w2 − ŵ2| per ẇ2, s", [_format_lag(report) for report in reports]),
        ("fastest β on the rig, rad/s", [_format_fastest(report, 1) for report in reports]),
        ("  with two samples of delay", [_format_fastest(report, 2) for report in reports]),
        ("  ideal", [_format_fastest(report, 0) for report in reports]),
        ("sampled starts that come to rest", [_format_share(report.rigid) for report in reports]),
        ("  with φ ±0.3 rad, φ̇ ±5 rad/s", [_format_share(report.deflected) for report in reports]),
    ]
    for report in reports:
        table.add_column(f"{report.sigma:g}", justify="right")
    for name, values in rows:
        table.add_row(name, *values)
    return table


def _build_range_table(reports: "list[Report]") -> Table:
    from svsa.analysis.design.robustness import MAX_RATIO, MIN_RATIO

    table = Table(
        "true / nominal",
        title="Stays stable, one parameter at a time",
        caption=f"looked for from {MIN_RATIO:g} to {MAX_RATIO:g}",
        title_justify="left",
        caption_justify="left",
    )
    table.add_column("now", justify="right")
    for report in reports:
        table.add_column(f"σ = {report.sigma:g}", justify="right")
    for rows in zip(*(report.stability.ranges for report in reports), strict=True):
        ends = [_format_range(row) for row in rows]
        table.add_row(rows[0].symbol, f"{rows[0].present:.2f}", *ends)
    return table


def _format_range(stable_range: "StableRange") -> str:
    low, high = stable_range.low, stable_range.high
    if high is None:
        return "all" if low is None else f"from {low:.2f}"
    return f"up to {high:.2f}" if low is None else f"{low:.2f} – {high:.2f}"


def _format_degrees(gain: float | None) -> str:
    if gain is None:
        return "–"
    return f"{math.degrees(gain):.4f}" if math.isfinite(gain) else "none: w itself stays"


def _format_ramps(report: "Report") -> str:
    if not math.isfinite(report.stability.gain.ramp):
        return "–"
    return ", ".join("fault" if r.fault else f"{math.degrees(r.gain):.4f}" for r in report.ramps)


def _format_lag(report: "Report") -> str:
    lags = [ramp.lag for ramp in report.ramps if ramp.lag is not None]
    return f"{lags[-1]:.4f}" if lags else "–"


def _format_fastest(report: "Report", delay: int) -> str:
    if not report.is_observed:
        return "–"
    beta: Any = report.fastest[delay]
    return "over 1000" if beta is None else f"{beta:.0f}"


def _format_share(outcomes: "dict[Cell, StartOutcome]") -> str:
    from svsa.analysis.design.attraction import compute_share

    return f"{compute_share(list(outcomes.values())):.2f}" if outcomes else "–"
