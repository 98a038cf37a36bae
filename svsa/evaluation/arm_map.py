"""`svsa arm-map`: the error of an arm under a mass at its tip, over mass and stiffness."""

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from svsa.control.gains import Gains
from svsa.control.installed import get_title
from svsa.control.law_names import AnyLaw
from svsa.errors import SvsaError
from svsa.inputs.output_file import check_picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MASSES_KG = (0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0)
STIFFNESSES_NM_PER_RAD = (10.0, 20.0, 40.0, 60.0, 80.0, 100.0, 140.0)
LOAD_S, WINDOW_S = 5.0, (8.0, 20.0)
_STIFFNESS_POLE = 40.0


class ArmMap(NamedTuple):
    """The rms position error of a controller under load, over tip mass and stiffness.

    The error is that of the worse joint from 8 to 20 s; infinite if the run ended in a fault.

    Attributes:
        title: Name of the controller.
        errors_deg: (stiffnesses, masses), degrees.
        masses_kg: Tip masses, kg.
        stiffnesses_nm_per_rad: Stiffnesses of both joints, N·m/rad.
    """

    title: str
    errors_deg: np.ndarray
    masses_kg: tuple[float, ...]
    stiffnesses_nm_per_rad: tuple[float, ...]


def measure_arm_map(
    law: str,
    settings: Mapping[str, Any],
    title: str,
    masses: Sequence[float] = MASSES_KG,
    stiffnesses: Sequence[float] = STIFFNESSES_NM_PER_RAD,
) -> ArmMap:
    """Simulate an arm for every tip mass and stiffness; the mass is added at 5 s.

    Args:
        law: Name of the law of both joints.
        settings: Further arguments of `simulate_arm`.
        title: Name of the controller.
        masses: Tip masses, kg.
        stiffnesses: Stiffnesses of both joints, N·m/rad.

    Returns:
        The map of rms position errors.
    """
    # Imported here: every command of `svsa` imports this file.
    from svsa.runs.result.simulate_arm import simulate_arm
    from svsa.simulation.plant.loads.tip import TipMass

    errors = np.full((len(stiffnesses), len(masses)), math.inf)
    for i, stiffness in enumerate(stiffnesses):
        for j, mass in enumerate(masses):
            loads = [TipMass(mass_kg=mass, start_s=LOAD_S)] if mass else []
            run = simulate_arm(law=AnyLaw(law), stiffness=stiffness, tip_loads=loads, **settings)
            if run.fault is None:
                errors[i, j] = math.degrees(max(run.measure(*WINDOW_S)))
    return ArmMap(title, errors, tuple(masses), tuple(stiffnesses))


def draw_arm_maps(maps: Sequence[ArmMap]) -> "Figure":
    """Draw a panel for each controller; needs the extra `plot`. A cross is a fault.

    Args:
        maps: Maps with equal masses and stiffnesses.

    Returns:
        The Matplotlib figure.
    """
    from matplotlib.colors import LogNorm
    from matplotlib.figure import Figure

    width = min(3, len(maps))
    height = math.ceil(len(maps) / width)
    figure = Figure(figsize=(4.2 * width, 2.9 * height + 0.4), layout="constrained")
    axes = np.atleast_1d(figure.subplots(height, width, sharex=True, sharey=True)).ravel()
    shown: Any = None
    for axis, error_map in zip(axes, maps, strict=False):
        errors = np.ma.masked_invalid(error_map.errors_deg)
        shown = axis.imshow(
            errors, norm=LogNorm(0.01, 30.0), cmap="viridis_r", origin="lower", aspect="auto"
        )
        for i, j in np.argwhere(~np.isfinite(error_map.errors_deg)):
            axis.plot(j, i, "x", color="tab:red", markersize=5)
        axis.set_title(error_map.title, fontsize=10)
        columns = _list_labels(error_map.masses_kg)
        rows = _list_labels(error_map.stiffnesses_nm_per_rad)
        axis.set_xticks(range(len(columns)), columns, fontsize=7)
        axis.set_yticks(range(len(rows)), rows, fontsize=8)
    for axis in axes[len(maps) :]:
        axis.set_visible(False)
    figure.supxlabel("tip mass [kg]", fontsize=10)
    figure.supylabel("stiffness σ [N·m/rad]", fontsize=10)
    figure.colorbar(shown, ax=list(axes), label="rms position error [°], × fault")
    return figure


def arm_map(
    laws: Annotated[
        list[str], typer.Argument(help="Names of installed laws, such as fl and ndobc.")
    ],
    adaptive: Annotated[
        list[str] | None,
        typer.Option(help="Law with feedforward and adaptive payload; repeatable."),
    ] = None,
    pole: Annotated[
        float,
        typer.Option(
            help="All position poles at −POLE, of laws with gains, rad/s.", min=1.0, max=200.0
        ),
    ] = 60.0,
    observer: Annotated[
        float, typer.Option(help="Bandwidth of the observer, rad/s.", min=0.1, max=1000.0)
    ] = 60.0,
    plot: Annotated[Path | None, typer.Option(help="Picture file (.png, .pdf, .svg).")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Map the error of an arm's controllers over tip mass and stiffness."""
    check_picture("--plot", plot)
    gains = Gains.from_poles([-pole] * 4, [-_STIFFNESS_POLE] * 2)
    common = {"gains": gains, "observer": observer}
    adapted = {**common, "feedforward": True, "adaptation": True}
    try:
        maps = [measure_arm_map(law, common, get_title(law)) for law in laws]
        maps += [
            measure_arm_map(law, adapted, f"{get_title(law)}, adaptive payload")
            for law in adaptive or ()
        ]
    except SvsaError as error:
        Console(stderr=True).print(f"Error: {error}", style="bold red", markup=False)
        raise typer.Exit(2) from None
    if plot is not None:
        draw_arm_maps(maps).savefig(plot, dpi=110)
    if as_json:
        errors = {
            error_map.title: [[_plain(error) for error in row] for row in error_map.errors_deg]
            for error_map in maps
        }
        axes = {"tip_mass_kg": MASSES_KG, "stiffness_nm_per_rad": STIFFNESSES_NM_PER_RAD}
        typer.echo(json.dumps(axes | {"rms_position_error_deg": errors}))
        return
    Console().print(*map(_build_table, maps), highlight=False)


def _list_labels(values: Sequence[float]) -> list[str]:
    return [f"{value:g}" for value in values]


def _plain(error: float) -> float | None:
    return float(error) if math.isfinite(error) else None


def _build_table(error_map: ArmMap) -> Table:
    title = f"{error_map.title}: rms position error [°] over σ [N·m/rad] and tip mass [kg]"
    table = Table("σ", *_list_labels(error_map.masses_kg), title=title, padding=0)
    labels = _list_labels(error_map.stiffnesses_nm_per_rad)
    for label, row in zip(labels, error_map.errors_deg, strict=True):
        cells = (f"{error:.2g}" if math.isfinite(error) else "fault" for error in row)
        table.add_row(label, *cells)
    return table
