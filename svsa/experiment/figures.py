"""Pictures: the paper's figures as the paper lays them out, and one run at a glance."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Picture

from svsa.control.installed import list_law_names
from svsa.experiment.result import Result, name_law
from svsa.paper import LOAD_TIME_S, get_figure

if TYPE_CHECKING:
    from svsa.experiment.reproduce import Reproduction

REFERENCE_STYLE = {"color": "#444444", "linestyle": "--", "linewidth": 1.2, "zorder": 3}
LAW_COLORS = ("#0072B2", "#D55E00", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
OWN_COLOR = "#009E73"
CHANNEL_COLORS = ("#0072B2", "#D55E00", "#009E73")


def style_law(law: str) -> dict[str, Any]:
    """How the curves of a law look: each that is installed has a colour until they run out."""
    laws = list_law_names()
    color = LAW_COLORS[laws.index(law) % len(LAW_COLORS)] if law in laws else OWN_COLOR
    return {"color": color, "linewidth": 1.3, "label": name_law(law)}


def draw_figure(runs: "Sequence[Reproduction]") -> Picture:
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
    _label(tracking, "Position [°]")
    _label(error, "Position error [°]")
    _label(stiffness, "Stiffness [N·m/rad]")
    _label(stiffness_error, "Stiffness error\n[N·m/rad]")
    stiffness_error.set_xlabel("Time [s]")
    for axes in (tracking, error, stiffness, stiffness_error):
        axes.axvline(LOAD_TIME_S, color="#888888", linewidth=0.8, linestyle=":")
    return picture


def plot_run(result: Result) -> Picture:
    """One run: position, its error, stiffness, torques, disturbance true and estimated."""
    picture = Picture(figsize=(8.0, 10.0), layout="constrained")
    position, error, stiffness, torque, disturbance = picture.subplots(5, 1, sharex=True)
    time, period = result.time_s, result.configuration.sampling.period_s
    position.plot(
        time, np.degrees(result.position_reference_rad), label="reference", **REFERENCE_STYLE
    )
    for law, rows in result.list_stretches():
        style, at = style_law(law), time[rows]
        position.plot(at, np.degrees(result.position_rad[rows]), **style)
        error.plot(at, np.degrees(result.position_error_rad[rows]), **style)
        stiffness.plot(at, result.stiffness_nm_per_rad[rows], **style)
    stiffness.plot(
        time, result.stiffness_reference_nm_per_rad, label="reference", **REFERENCE_STYLE
    )
    torque.plot(time, result.torque1_nm, color=CHANNEL_COLORS[0], label="u1")
    torque.plot(time, result.torque2_nm, color=CHANNEL_COLORS[1], label="u2")
    for part, color in zip(("link", "motor1", "motor2"), CHANNEL_COLORS, strict=True):
        true, estimate = (
            getattr(result, f"disturbance_{part}_nm"),
            getattr(result, f"estimate_{part}_nm"),
        )
        disturbance.plot(time, true, color=color, linestyle="--", linewidth=1.0)
        disturbance.plot(time, estimate, color=color, label=part)
    _label(position, "Position [°]")
    _label(error, "Position error [°]")
    _label(stiffness, "Stiffness [N·m/rad]")
    _label(torque, "Torque [N·m]")
    _label(disturbance, "Disturbance [N·m]\n(true dashed)")
    disturbance.set_xlabel("Time [s]")
    for axes in (position, error, stiffness, torque, disturbance):
        for moment in {command.tick * period for command in result.commands}:
            axes.axvline(moment, color="#888888", linewidth=0.8, linestyle=":")
    return picture


def save_figures(runs: "Sequence[Reproduction]", folder: Path) -> list[Path]:
    """One PNG a figure in `folder`; returns their paths. Raises `OSError` where it cannot."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for key in dict.fromkeys(run.figure for run in runs):
        path = folder / f"figure_{key}.png"
        draw_figure([run for run in runs if run.figure == key]).savefig(path, dpi=130)
        paths.append(path)
    return paths


def _label(axes: Axes, text: str) -> None:
    axes.set_ylabel(text)
    axes.grid(alpha=0.25)
    axes.margins(x=0)
    if axes.get_legend_handles_labels()[0]:
        named = dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
        axes.legend(named.values(), named, loc="upper right", fontsize="small", ncols=3)
