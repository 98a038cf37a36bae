"""Pictures of the ranking: the table as bars, the six sweeps as a web, one law beside NDOBC."""

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Picture
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullLocator

from svsa.actuators.faults import label_fault
from svsa.control.installed import BASELINE, PAPERS_LAW, get_title
from svsa.evaluation.ranking.measure import Entry, run_scenario
from svsa.evaluation.ranking.results import Results
from svsa.evaluation.ranking.row import Row
from svsa.evaluation.ranking.scenarios import (
    LOAD_REMOVAL,
    RIG_4A,
    SINE_2HZ,
    Scenario,
    build_link_step,
)
from svsa.runs.result.law_style import COLORS, style_law

BAD, GOOD, MARKED = "#c0892b", "#0072B2", "#1b2733"
PARTS = (("robustness", "#0072B2", 0.5), ("trials", "#009E73", 0.3), ("accuracy", "#CC79A7", 0.2))
SWEEPS = ("model", "noise", "torque\nnoise", "torque\nlag", "delay", "pushes")


class Panel(NamedTuple):
    """A column of the table. scenario: the run that may have ended early."""

    title: str
    read: Callable[[Row], float | None]
    scenario: str = ""
    is_log: bool = True


PANELS = (
    Panel("4A on the rig: peak [°]", lambda row: row.rig_4a.peak_deg, "rig_4a"),
    Panel("… settled [°]", lambda row: row.rig_4a.steady_deg, "rig_4a"),
    Panel("load removal: peak [°]", lambda row: row.load_removal_peak_deg, "load_removal"),
    Panel("faults of 48 load removals", lambda row: row.load_removal_faults_of_48, is_log=False),
    Panel("… settled, worst [°]", lambda row: row.load_removal_steady_state_deg),
    Panel("2 Hz: rms [°]", lambda row: row.sine_2hz_rms_deg, "sine_2hz"),
    Panel("3 kg: rms [°]", lambda row: row.mass_rms_deg, "mass"),
    Panel("trials that fail, of 100", lambda row: row.trials_fails, is_log=False),
    Panel("largest step [N·m]", lambda row: row.largest_link_step_nm, is_log=False),
)


def save_comparison(results: Results, path: Path) -> None:
    """Every law's score with its parts, and the columns of the table, a bar a law."""
    rows = sorted(results.rows, key=lambda row: row.score)
    height = 1.4 + 0.24 * len(rows)
    picture = Picture(figsize=(16.5, height), layout="constrained")
    first, *others = picture.subplots(
        1, 1 + len(PANELS), sharey=True, width_ratios=[1.5] + [1] * len(PANELS)
    )
    left = np.zeros(len(rows))
    for name, color, weight in PARTS:
        widths = np.array([weight * getattr(row.parts, name) for row in rows])
        first.barh(range(len(rows)), widths, left=left, color=color, label=name)
        left += widths
    first.set_yticks(range(len(rows)), [get_title(row.law) for row in rows])
    for row, end, tick in zip(rows, left, first.get_yticklabels(), strict=True):
        first.text(end, rows.index(row), f" {row.score:.2f}", va="center", fontsize=8)
        tick.set_fontweight("bold" if row.law == PAPERS_LAW else "normal")
    first.set(title="score", xlim=(0.0, 1.0))
    first.legend(fontsize=7, loc="lower right")
    for axes, panel in zip(others, PANELS, strict=True):
        _draw_panel(axes, panel, rows)
    for axes in (first, *others):
        axes.grid(axis="x", alpha=0.25)
        axes.title.set_fontsize(9)
        axes.tick_params(labelsize=8)
    picture.savefig(path, dpi=110)


def _draw_panel(axes: Axes, panel: Panel, rows: Sequence[Row]) -> None:
    for at, row in enumerate(rows):
        value, fault = panel.read(row), row.faults.get(panel.scenario, "")
        if value is None:
            reported = (
                label_fault(fault).lower() if fault else "never" if panel.scenario else "fault"
            )
            axes.text(0.03, at, reported, va="center", fontsize=7.5, color="#a8201a",
                      transform=axes.get_yaxis_transform())  # fmt: skip
            continue
        color = GOOD if panel.title.startswith("largest") else BAD
        color = MARKED if row.law == PAPERS_LAW else color
        if panel.is_log:
            axes.plot(value, at, "o", color=color, markersize=7)
        else:
            axes.barh(at, value, color=color)
    if panel.is_log and any(panel.read(row) for row in rows):
        axes.set_xscale("log")
        axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0), numticks=6))
        axes.xaxis.set_major_formatter(FormatStrFormatter("%g"))
        axes.xaxis.set_minor_locator(NullLocator())
    axes.set_title(panel.title)


class Loss(NamedTuple):
    """A scenario in which NDOBC loses. window: what is shown, s."""

    title: str
    scenario: Scenario
    window: tuple[float, float]


LOSSES = (
    Loss("The load is taken off at 8 s", LOAD_REMOVAL, (7.8, 9.0)),
    Loss("2.5 N·m come on the link at 5 s", build_link_step(2.5), (4.8, 6.0)),
    Loss("1.5 N·m at 2 Hz on the link", SINE_2HZ, (4.8, 6.0)),
)
BEARS = "ndobc_w"


def save_losses(path: Path) -> None:
    """Where NDOBC loses: its errors beside those of FL and of NDOBC-W, on the rig at σ = 15."""
    picture = Picture(figsize=(12.0, 3.7), layout="constrained")
    for axes, loss in zip(picture.subplots(1, len(LOSSES)), LOSSES, strict=True):
        for law, color in zip((PAPERS_LAW, BASELINE, BEARS), COLORS, strict=False):
            style = style_law(law) | {"color": color, "linestyle": "-", "linewidth": 1.8}
            _draw_run(axes, loss, law, style)
        axes.set(title=loss.title, xlabel="Time [s]", xlim=loss.window)
        axes.title.set_fontsize(11)
        axes.grid(alpha=0.25)
        axes.axhline(0.0, color="#444444", linewidth=0.8)
    handles, names = picture.axes[0].get_legend_handles_labels()
    picture.legend(handles, names, loc="outside lower center", ncols=len(names), frameon=False)
    picture.axes[0].set_ylabel("Position error [°]")
    picture.savefig(path, dpi=110)


def _draw_run(axes: Axes, loss: Loss, law: str, style: dict[str, Any]) -> None:
    result = run_scenario(loss.scenario, Entry(law))
    shown = (result.time_s >= loss.window[0]) & (result.time_s < loss.window[1])
    time, degrees = result.time_s[shown], np.degrees(result.position_error_rad[shown])
    axes.plot(time, degrees, **style)
    if result.fault is not None and result.time_s[-1] < loss.window[1]:
        reported = f"{get_title(law)}: {label_fault(result.fault.code).lower()}"
        axes.plot(time[-1], degrees[-1], "X", color=style["color"], markersize=10)
        axes.annotate(
            reported,
            (time[-1], degrees[-1]),
            (9, -3),
            textcoords="offset points",
            fontsize=9,
            color=style["color"],
        )


def save_law(results: Results, law: str, path: Path) -> None:
    """A law beside NDOBC: figure 4A on the rig, load removal, and the six sweeps."""
    baseline = BASELINE if law == PAPERS_LAW else PAPERS_LAW
    picture = Picture(figsize=(11.0, 3.6), layout="constrained")
    grid = picture.add_gridspec(1, 3, width_ratios=(1.25, 1.25, 1.0))
    rig, load_removal = picture.add_subplot(grid[0, 0]), picture.add_subplot(grid[0, 1])
    web: Any = picture.add_subplot(grid[0, 2], projection="polar")
    shown_in = ((rig, RIG_4A, (4.8, 6.2)), (load_removal, LOAD_REMOVAL, (7.8, 9.2)))
    for name in (baseline, law):
        style = style_law(name)
        for axes, scenario, window in shown_in:
            result = run_scenario(scenario, Entry(name))
            shown = (result.time_s >= window[0]) & (result.time_s < window[1])
            degrees = np.degrees(result.position_error_rad)
            axes.plot(result.time_s[shown], degrees[shown], **style)
            if result.fault is not None and result.time_s[-1] < window[1]:
                axes.plot(result.time_s[-1], degrees[-1], "x", color=style["color"], markersize=9)
        _draw_web(web, results.get_row(name), style)
    rig.set(title="Figure 4A on the rig: the load comes", ylabel="Position error [°]")
    load_removal.set(title="Load removal (×: fault)", ylabel="Position error [°]")
    web.set_title("Share of six sweeps that held", fontsize=10)
    for axes in (rig, load_removal):
        axes.set_xlabel("Time [s]")
        axes.title.set_fontsize(10)
        axes.grid(alpha=0.25)
    rig.legend(fontsize=8)
    picture.savefig(path, dpi=90)


def _draw_web(web: Any, row: Row, style: dict[str, Any]) -> None:
    angles = [2.0 * math.pi * at / len(row.sweeps) for at in range(len(row.sweeps))]
    shares = [sweep.share for sweep in row.sweeps]
    web.plot([*angles, angles[0]], [*shares, shares[0]], **style)
    web.fill(angles, shares, color=style["color"], alpha=0.08)
    web.set_theta_zero_location("N")
    web.set_theta_direction(-1)
    web.set_xticks(angles, SWEEPS, fontsize=8)
    web.set(ylim=(0.0, 1.0), yticks=[0.25, 0.5, 0.75, 1.0], yticklabels=[])
