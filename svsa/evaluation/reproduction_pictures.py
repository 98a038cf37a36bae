"""The paper's figures as the paper lays them out."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure as Picture

from svsa.evaluation.reproduction import Reproduction
from svsa.runs.definition.paper import LOAD_TIME_S, get_figure
from svsa.runs.result.law_style import REFERENCE_STYLE, style_law
from svsa.runs.result.plot import label_axes


def draw_figure(runs: Sequence[Reproduction]) -> Picture:
    """One figure of the paper: tracking, position error, stiffness and its error."""
    figure = get_figure(runs[0].figure)
    picture = Picture(figsize=(8.0, 9.0), layout="constrained")
    picture.suptitle(f"{figure.title}, 3 kg load at {LOAD_TIME_S:g} s")
    tracking, error, stiffness, stiffness_error = picture.subplots(4, 1, sharex=True)
    first = runs[0].result
    tracking.plot(
        first.time_s, np.degrees(first.position_reference_rad), label="reference", **REFERENCE_STYLE
    )
    stiffness.plot(
        first.time_s, first.stiffness_reference_nm_per_rad, label="reference", **REFERENCE_STYLE
    )
    for run in runs:
        style, result = style_law(run.law), run.result
        tracking.plot(result.time_s, np.degrees(result.position_rad), **style)
        error.plot(result.time_s, np.degrees(result.position_error_rad), **style)
        stiffness.plot(result.time_s, result.stiffness_nm_per_rad, **style)
        stiffness_error.plot(result.time_s, result.stiffness_error_nm_per_rad, **style)
    label_axes(tracking, "Position [°]")
    label_axes(error, "Position error [°]")
    label_axes(stiffness, "Stiffness [N·m/rad]")
    label_axes(stiffness_error, "Stiffness error\n[N·m/rad]")
    stiffness_error.set_xlabel("Time [s]")
    for axes in (tracking, error, stiffness, stiffness_error):
        axes.axvline(LOAD_TIME_S, color="#888888", linewidth=0.8, linestyle=":")
    return picture


def save_figures(runs: Sequence[Reproduction], folder: Path) -> list[Path]:
    """Save one PNG per figure in `folder`; return their paths.

    Raises:
        OSError: If a file cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for key in dict.fromkeys(run.figure for run in runs):
        path = folder / f"figure_{key}.png"
        draw_figure([run for run in runs if run.figure == key]).savefig(path, dpi=130)
        paths.append(path)
    return paths
