"""The overview figure of one run."""

from collections.abc import Collection, Iterable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Picture

from svsa.runs.result.channels import Channels
from svsa.runs.result.law_style import REFERENCE_STYLE, style_law

CHANNEL_COLORS = ("#0072B2", "#D55E00", "#009E73")


def plot_run(
    run: Channels, stretches: Iterable[tuple[str, slice]], changes_s: Collection[float]
) -> Picture:
    """Plot one run: position, its error, stiffness, torques, true and estimated disturbance.

    Args:
        run: The channels.
        stretches: Laws in control, each with its rows.
        changes_s: Times of changes, s.

    Returns:
        A matplotlib figure.
    """
    picture = Picture(figsize=(8.0, 10.0), layout="constrained")
    position, error, stiffness, torque, disturbance = picture.subplots(5, 1, sharex=True)
    time = run.time_s
    position.plot(
        time, np.degrees(run.position_reference_rad), label="reference", **REFERENCE_STYLE
    )
    for law, rows in stretches:
        style, at = style_law(law), time[rows]
        position.plot(at, np.degrees(run.position_rad[rows]), **style)
        error.plot(at, np.degrees(run.position_error_rad[rows]), **style)
        stiffness.plot(at, run.stiffness_nm_per_rad[rows], **style)
    stiffness.plot(time, run.stiffness_reference_nm_per_rad, label="reference", **REFERENCE_STYLE)
    torque.plot(time, run.torque1_nm, color=CHANNEL_COLORS[0], label="u1")
    torque.plot(time, run.torque2_nm, color=CHANNEL_COLORS[1], label="u2")
    for part, color in zip(("link", "motor1", "motor2"), CHANNEL_COLORS, strict=True):
        true, estimate = (
            getattr(run, f"disturbance_{part}_nm"),
            getattr(run, f"estimate_{part}_nm"),
        )
        disturbance.plot(time, true, color=color, linestyle="--", linewidth=1.0)
        disturbance.plot(time, estimate, color=color, label=part)
    label_axes(position, "Position [°]")
    label_axes(error, "Position error [°]")
    label_axes(stiffness, "Stiffness [N·m/rad]")
    label_axes(torque, "Torque [N·m]")
    label_axes(disturbance, "Disturbance [N·m]\n(true dashed)")
    disturbance.set_xlabel("Time [s]")
    for axes in (position, error, stiffness, torque, disturbance):
        for moment in changes_s:
            axes.axvline(moment, color="#888888", linewidth=0.8, linestyle=":")
    return picture


def label_axes(axes: Axes, text: str) -> None:
    """Name the value axis, and the curves in a legend."""
    axes.set_ylabel(text)
    axes.grid(alpha=0.25)
    axes.margins(x=0)
    if axes.get_legend_handles_labels()[0]:
        named = dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
        axes.legend(named.values(), named, loc="upper right", fontsize="small", ncols=3)
