"""The picture of `svsa stability`."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure as Picture

from svsa.analysis.design.attraction import Cell, StartOutcome, build_map, compute_share
from svsa.analysis.design.report import Report
from svsa.analysis.design.sampled_loop import compute_disturbance_response, find_fastest_observer
from svsa.control.gains import Gains
from svsa.control.installed import get_law
from svsa.runs.definition.configuration import Configuration
from svsa.simulation.plant.effects import IDEAL, RIG

COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
CURVE_STIFFNESSES = (5.0, 15.0, 30.0, 60.0)
CURVE_POLES = np.arange(20.0, 101.0, 10.0)
_OUTCOMES = {"rest": 0, "fault": 1, "unsettled": 2}
_OUTCOME_COLORS = ("#8fc7e8", "#f0b49b", "#b9b9b9")


def save_picture(configuration: Configuration, reports: Sequence[Report], path: Path) -> None:
    """Poles, e over w, the fastest observer over the poles, and both maps of the first report."""
    picture = Picture(figsize=(9.6, 10.6), layout="constrained")
    title, beta = get_law(configuration.law).title, configuration.observer.bandwidth_rad_per_s[0]
    picture.suptitle(f"{title}, β = {beta:g} rad/s, plant and nominal model not the same")
    axes = picture.subplot_mosaic(
        [["poles", "bode"], ["observer", "observer"], ["rigid", "deflected"]]
    )
    _draw_poles(axes["poles"], reports)
    _draw_bode(axes["bode"], configuration, reports)
    _draw_fastest(axes["observer"], configuration)
    sigma, rigid, deflected = reports[0].sigma, reports[0].rigid, reports[0].deflected
    _draw_attraction(axes["rigid"], f"σ = {sigma:g}, φ0 = φ̇0 = 0", rigid)
    _draw_attraction(axes["deflected"], f"σ = {sigma:g}, φ0 ±0.3 rad, φ̇0 ±5 rad/s", deflected)
    picture.savefig(path, dpi=130)


def _draw_poles(axes: Axes, reports: Sequence[Report]) -> None:
    axes.axvspan(0.0, 20.0, color="#f6d5d5")
    axes.axvline(0.0, color="#444444", linewidth=0.8)
    for report, color in zip(reports, COLORS, strict=False):
        s = report.stability.loop.poles
        label = f"σ = {report.sigma:g}: slowest {report.stability.loop.slowest:.1f}"
        axes.plot(
            np.real(s), np.imag(s), "x", color=color, label=label, markersize=7, markeredgewidth=2
        )
    axes.set(title="Poles of the closed loop, continuous", xlabel="Re [rad/s]", ylabel="Im [rad/s]")
    _finish(axes)


def _draw_bode(axes: Axes, configuration: Configuration, reports: Sequence[Report]) -> None:
    for report, color in zip(reports, COLORS, strict=False):
        for effects, style, name in ((IDEAL, "-", "ideal"), (RIG, "--", "rig")):
            response = compute_disturbance_response(
                configuration.changed(effects=effects), report.sigma
            )
            if response.is_stable:
                label = f"σ = {report.sigma:g}, {name}"
                axes.loglog(
                    response.frequency,
                    np.degrees(response.magnitude),
                    style,
                    color=color,
                    label=label,
                )
    axes.set(
        title="Disturbance on the link → error",
        xlabel="Hz",
        ylabel="° per N·m",
        xlim=(0.1, 100.0),
        ylim=(0.01, 5.0),
    )
    _finish(axes)


def _draw_fastest(axes: Axes, configuration: Configuration) -> None:
    on_rig = configuration.changed(effects=RIG)
    stiffness = configuration.gains.stiffness_roots
    for sigma, color in zip(CURVE_STIFFNESSES, COLORS, strict=False):
        curve = [
            find_fastest_observer(
                on_rig.changed(gains=Gains.from_poles([-float(pole)] * 4, stiffness)), sigma
            )
            for pole in CURVE_POLES
        ]
        known = [np.nan if beta is None else beta for beta in curve]
        axes.plot(CURVE_POLES, known, "o-", markersize=3, color=color, label=f"σ = {sigma:g}")
    axes.set(
        title="Fastest stable observer on the rig",
        xlabel="position pole [rad/s]",
        ylabel="β [rad/s]",
    )
    _finish(axes)


def _draw_attraction(axes: Axes, drawn: str, outcomes: dict[Cell, StartOutcome]) -> None:
    if not outcomes:
        axes.set_axis_off()
        return
    count = 1 + max(cell.row for cell in outcomes)
    grid = np.zeros((count, count))
    for cell, start in outcomes.items():
        grid[cell] = _OUTCOMES[start.outcome]
    starts = build_map(count)
    for (outcome, number), color in zip(_OUTCOMES.items(), _OUTCOME_COLORS, strict=True):
        if np.any(grid == number):
            axes.plot([], [], "s", color=color, label=outcome)
    axes.legend(fontsize=8, loc="lower left")
    axes.pcolormesh(
        np.degrees(starts.positions),
        starts.velocities,
        grid,
        cmap=ListedColormap(_OUTCOME_COLORS),
        vmin=0,
        vmax=2,
    )
    share = compute_share(list(outcomes.values()))
    axes.set(
        title=f"Rig, {drawn}\n{share:.2f} of {count} × {count} starts come to rest; no proof",
        xlabel="q0 [°]",
        ylabel="q̇0 [rad/s]",
    )


def _finish(axes: Axes) -> None:
    axes.grid(True, color="#dddddd", linewidth=0.6)
    if axes.get_legend_handles_labels()[1]:
        axes.legend(fontsize=8)
