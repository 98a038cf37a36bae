"""A scenario as a picture: the load, and the errors of laws beside each other."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure as Picture

from svsa.control.installed import get_title
from svsa.falsify.scenario import LoadScenario
from svsa.fault_labels import label_fault
from svsa.plant.disturbances import build_load_table, compute_load
from svsa.result.law_style import style_law
from svsa.result.simulate import simulate
from svsa.run.configuration import Configuration
from svsa.run.loads import follow_loads

BODIES = (("link", "#1b2733", "-"), ("motor 1", "#c0892b", "--"), ("motor 2", "#7a4fa3", ":"))
BEFORE_S = 1.0
"""How much is shown before the first load."""


def save_picture(scenario: LoadScenario, laws: Sequence[str], path: Path) -> None:
    """The torques of the loads, position error and stiffness error; × is where a run faulted."""
    runs = [(law, scenario.build_configuration(law)) for law in laws]
    picture = Picture(figsize=(9.0, 7.0), layout="constrained")
    torque, position, stiffness = picture.subplots(3, 1, sharex=True, height_ratios=(1, 1.6, 1.2))
    times, sizes = sample_torque(runs[0][1], scenario.duration_s)
    for size, (body, color, dash) in zip(sizes.T, BODIES, strict=True):
        if np.any(size):
            torque.step(times, size, where="post", color=color, linestyle=dash, label=body)
    for law, configuration in runs:
        result, style = simulate(configuration, duration_s=scenario.duration_s), style_law(law)
        for axes, error in (
            (position, np.degrees(result.position_error_rad)),
            (stiffness, result.stiffness_error_nm_per_rad),
        ):
            axes.plot(result.time_s, error, **style)
            if result.fault is not None:
                axes.plot(result.time_s[-1], error[-1], "X", color=style["color"], markersize=10)
        if result.fault is not None:
            told = f"{get_title(law)}: {label_fault(result.fault.code).lower()}"
            at = result.time_s[-1], np.degrees(result.position_error_rad[-1])
            position.annotate(told, at, (9, -3), textcoords="offset points", fontsize=9)
    torque.set(title=scenario.title, ylabel="Load [N·m]")
    position.set(ylabel="Position error [°]")
    stiffness.set(ylabel="Stiffness error\n[N·m/rad]", xlabel="Time [s]")
    onsets = [load.start_s for load in scenario.loads if load.start_s is not None]
    stiffness.set_xlim(max(0.0, min(onsets, default=0.0) - BEFORE_S), scenario.duration_s)
    for axes in (torque, position, stiffness):
        axes.grid(alpha=0.25)
        axes.axhline(0.0, color="#444444", linewidth=0.8)
    if np.any(sizes):
        torque.legend(fontsize=8)
    position.legend(fontsize=8)
    picture.savefig(path, dpi=110)


def sample_torque(configuration: Configuration, duration_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Times, s, and of each the loads' torques on link, motor 1 and motor 2, N·m: (n,), (n, 3).

    The weight of a mass is none of them: it depends on where the link is.
    """
    period = configuration.sampling.period_s
    table = build_load_table(follow_loads(configuration.loads, (), period))
    ticks = range(round(duration_s / period))
    sizes = [compute_load(table, tick, period, tick * period)[:3] for tick in ticks]
    return period * np.arange(len(ticks)), np.array(sizes)
