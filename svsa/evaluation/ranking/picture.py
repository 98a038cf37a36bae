"""Figures of the ranking: errors over effort, a law compared with NDOBC, failures of NDOBC."""

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Picture

from svsa.actuators.faults import label_fault
from svsa.control.installed import BASELINE
from svsa.evaluation.ranking.entry import DECLARED, build_entry, get_entry_title, get_reference
from svsa.evaluation.ranking.results import Results
from svsa.evaluation.ranking.row import QUANTILES, FamilyOutcome
from svsa.evaluation.ranking.scenarios import find_scenario
from svsa.evaluation.ranking.table import RMS
from svsa.evaluation.scenario import Scenario
from svsa.runs.result.law_style import COLORS, style_law
from svsa.runs.result.simulate import simulate

STIFFNESS_RMS, TORQUE_RMS = "rms_stiffness_error_nm_per_rad", "rms_torque1_nm"


class Panel(NamedTuple):
    """A scenario, and the time range that is drawn, s."""

    title: str
    scenario: Scenario
    window: tuple[float, float]


def save_pareto(results: Results, path: Path) -> None:
    """Draw median position error over median stiffness error of family A; marker size is effort."""
    picture = Picture(figsize=(9.0, 6.0), dpi=110, layout="constrained")
    axes = picture.subplots()
    points: list[tuple[str, float, float]] = []
    for row in results.rows:
        family = row.families["A"]
        numbers = [family.get_median(name) for name in (RMS, STIFFNESS_RMS, TORQUE_RMS)]
        if None in numbers:
            continue
        position, stiffness, torque = (float(number or 0.0) for number in numbers)
        style = style_law(row.law)
        color = "#444444" if row.key == DECLARED else style["color"]
        axes.scatter(np.degrees(position), stiffness, s=60.0 * torque, color=color, alpha=0.7)
        points.append((get_entry_title(row.key), float(np.degrees(position)), stiffness))
    axes.set(
        xscale="log", yscale="log", xlabel="Median of rms position error [°]",
        ylabel="Median of rms stiffness error [N·m/rad]",
        title="Trials of family A; area: median of rms u1",
    )  # fmt: skip
    axes.grid(alpha=0.25, which="both")
    picture.draw_without_rendering()  # fixes the scales that place the labels
    _label_points(axes, points)
    picture.savefig(path)


def _label_points(axes: Axes, points: list[tuple[str, float, float]]) -> None:
    """Label each point, moved up until labels do not overlap, with a line to the point."""
    height, width = 13.0, 6.0  # height of a line and width of a character, pixels
    taken: list[tuple[float, float, float]] = []
    right = axes.bbox.x1
    for title, x, y in sorted(points, key=lambda point: point[2]):
        left, base = axes.transData.transform((x, y))
        space = width * len(title)
        start = left + 10.0 if left + 10.0 + space < right else left - 10.0 - space
        level = base
        while any(
            abs(level - other) < height and start < end and begin < start + space
            for other, begin, end in taken
        ):
            level += height / 4.0
        taken.append((level, start, start + space))
        axes.annotate(
            title, (x, y), (start, level), textcoords="figure pixels", fontsize=8, va="center",
            arrowprops={"arrowstyle": "-", "linewidth": 0.5, "color": "#888888"},
        )  # fmt: skip


def save_losses(path: Path) -> None:
    """Draw failures of NDOBC with the declared gains: its errors next to those of FL and
    NDOBC-W.
    """
    runs = (
        Panel("The load comes off", find_scenario("load_removal.positive.0"), (4.8, 6.5)),
        Panel("2.5 N·m on the link", find_scenario("link_step_2.5.positive.0"), (4.8, 6.5)),
        Panel("1.5 N·m at 2 Hz", find_scenario("sine_2hz.positive.0"), (4.8, 6.5)),
    )
    picture = Picture(figsize=(12.0, 3.7), layout="constrained")
    for axes, shown in zip(picture.subplots(1, len(runs)), runs, strict=True):
        for key, color in zip((DECLARED, BASELINE, "ndobc_w"), COLORS, strict=False):
            _draw_run(axes, shown, key, {"color": color, "linewidth": 1.8})
    handles, names = picture.axes[0].get_legend_handles_labels()
    picture.legend(handles, names, loc="outside lower center", ncols=len(names), frameon=False)
    picture.axes[0].set_ylabel("Position error [°]")
    picture.savefig(path, dpi=110)


def save_law(results: Results, key: str, path: Path) -> None:
    """Draw a row compared with NDOBC: two runs, and the trials' errors."""
    picture = Picture(figsize=(11.0, 3.6), layout="constrained")
    rig, removal, trials = picture.subplots(1, 3)
    shown = (
        (rig, Panel("Paper's load on the rig", find_scenario("rig_4a.positive.0"), (4.8, 6.5))),
        (removal, Panel("Load removal", find_scenario("load_removal.positive.0"), (4.8, 6.5))),
    )
    keys = (get_reference(key), key)
    for number, name in enumerate(keys):
        style = {"color": "#444444" if number == 0 else COLORS[0], "linewidth": 1.5}
        for axes, panel in shown:
            _draw_run(axes, panel, name, style)
        for family, line in (("A", "-"), ("B", "--")):
            label = f"{get_entry_title(name)}, {family}"
            outcome = results.get_row(name).families[family]
            _draw_distribution(trials, outcome, style | {"linestyle": line, "label": label})
    rig.set_ylabel("Position error [°]")
    rig.legend(fontsize=8)
    trials.set(
        xscale="log", ylim=(0.0, 1.0), xlabel="rms position error [°]", title="Share of trials"
    )
    trials.title.set_fontsize(10)
    trials.grid(alpha=0.25, which="both")
    trials.legend(fontsize=7)
    picture.savefig(path, dpi=90)


def _draw_distribution(axes: Axes, outcome: FamilyOutcome, style: dict[str, Any]) -> None:
    pairs = zip(outcome.metrics[RMS], QUANTILES, strict=True)
    known = [(np.degrees(value), share) for value, share in pairs if value is not None]
    axes.plot(*zip(*known, strict=True), **style) if known else None


def _draw_run(axes: Axes, shown: Panel, key: str, style: dict[str, Any]) -> None:
    scenario = shown.scenario
    configuration = build_entry(key).build_configuration(scenario)
    result = simulate(configuration, duration_s=scenario.duration_s)
    rows = (result.time_s >= shown.window[0]) & (result.time_s < shown.window[1])
    time, degrees = result.time_s[rows], np.degrees(result.position_error_rad[rows])
    axes.plot(time, degrees, label=get_entry_title(key), **style)
    if result.fault is not None and len(time) and result.time_s[-1] < shown.window[1]:
        label = label_fault(result.fault.code).lower()
        axes.plot(time[-1], degrees[-1], "X", color=style["color"], markersize=9)
        axes.annotate(
            label, (time[-1], degrees[-1]), (9, -3), textcoords="offset points", fontsize=8,
            color=style["color"],
        )  # fmt: skip
    axes.set(title=shown.title, xlabel="Time [s]", xlim=shown.window)
    axes.title.set_fontsize(10)
    axes.grid(alpha=0.25)
    axes.axhline(0.0, color="#444444", linewidth=0.6)
