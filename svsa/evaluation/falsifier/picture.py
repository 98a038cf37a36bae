"""A figure of a scenario: loads, and errors of several laws."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure as Picture

from svsa.actuators.faults import label_fault
from svsa.control.installed import get_title
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa.evaluation.falsifier.trace import trace_scenario
from svsa.runs.result.law_style import style_law

BODIES = (("link", "#1b2733", "-"), ("motor 1", "#c0892b", "--"), ("motor 2", "#7a4fa3", ":"))
BEFORE_S = 1.0
"""Time shown before the first load, s."""


def save_picture(scenario: LoadScenario, laws: Sequence[str], path: Path) -> None:
    """Draw the loads' torques, position error and stiffness error; × marks a fault."""
    traced = trace_scenario(scenario, laws)
    times = traced.time_s
    picture = Picture(figsize=(9.0, 7.0), layout="constrained")
    torque, position, stiffness = picture.subplots(3, 1, sharex=True, height_ratios=(1, 1.6, 1.2))
    for size, (body, color, dash) in zip(traced.torque_nm.T, BODIES, strict=True):
        if np.any(size):
            torque.step(times, size, where="post", color=color, linestyle=dash, label=body)
    for law, errors, fault in traced.laws:
        style, ends = style_law(law), len(errors) - 1
        shown = np.degrees(errors[:, 0]), errors[:, 1]
        for axes, error in zip((position, stiffness), shown, strict=True):
            axes.plot(times[: len(error)], error, **style)
            if fault is not None:
                axes.plot(times[ends], error[-1], "X", color=style["color"], markersize=10)
        if fault is not None:
            label = f"{get_title(law)}: {label_fault(fault).lower()}"
            at = times[ends], shown[0][-1]
            position.annotate(label, at, (9, -3), textcoords="offset points", fontsize=9)
    torque.set(title=scenario.title, ylabel="Load [N·m]")
    position.set(ylabel="Position error [°]")
    stiffness.set(ylabel="Stiffness error\n[N·m/rad]", xlabel="Time [s]")
    onsets = [load.start_s for load in scenario.loads if load.start_s is not None]
    stiffness.set_xlim(max(0.0, min(onsets, default=0.0) - BEFORE_S), scenario.duration_s)
    for axes in (torque, position, stiffness):
        axes.grid(alpha=0.25)
        axes.axhline(0.0, color="#444444", linewidth=0.8)
    if np.any(traced.torque_nm):
        torque.legend(fontsize=8)
    position.legend(fontsize=8)
    picture.savefig(path, dpi=110)
