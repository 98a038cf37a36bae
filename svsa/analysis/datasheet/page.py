"""A datasheet as one page: numbers, torque–deflection curves and workspaces."""

from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.figure import Figure as Picture

from svsa.analysis.datasheet.measure import Datasheet
from svsa.analysis.datasheet.rows import list_published, list_rows, write_figure


def draw_page(sheet: Datasheet) -> Picture:
    """Draw the datasheet.

    Args:
        sheet: Datasheet of an actuator.

    Returns:
        An A4 page.
    """
    page = Picture(figsize=(8.27, 11.69), layout="constrained")
    rows: list[Any] = [["numbers", "curves"], ["stiffness", "workspace"], ["speeds", "notes"]]
    parts = page.subplot_mosaic([*rows, ["published"] * 2], height_ratios=(1.1, 1.0, 1.0, 0.6))
    numbers, notes, published = (parts[name] for name in ("numbers", "notes", "published"))
    curves, stiffness, workspace, speeds = (
        parts[name] for name in ("curves", "stiffness", "workspace", "speeds")
    )
    page.suptitle(f"{sheet.title}\n{sheet.source}", fontsize=11)
    for axes in (numbers, notes, published):
        axes.axis("off")
    table = numbers.table(
        cellText=[[name, value] for name, value in list_rows(sheet)],
        colWidths=[0.56, 0.46],
        loc="center left",
        cellLoc="left",
    )
    table.auto_set_font_size(value=False)
    table.set_fontsize(6.0)
    table.scale(1.0, 1.6)
    table.set_in_layout(False)  # otherwise the curves become as narrow as the text permits
    for preset in sheet.presets:
        label = f"σ = {write_figure(preset.stiffness_nm_per_rad)}"
        deflection = np.degrees(preset.deflection_rad)
        curves.plot(deflection, preset.torque_nm, label=label)
        stiffness.plot(deflection, preset.stiffness_at_nm_per_rad, label=label)
    curves.set(xlabel="Deflection [°]", ylabel="Torque [N·m]", title="Presets (σ in N·m/rad)")
    curves.legend(fontsize=7)
    stiffness.set(xlabel="Deflection [°]", ylabel="Stiffness [N·m/rad]", yscale="log")
    torque, least, greatest = np.array(sheet.torque_stiffness).T
    workspace.fill_between(torque, least, greatest, alpha=0.4)
    workspace.set(
        xlabel="Torque at rest [N·m]",
        ylabel="Stiffness [N·m/rad]",
        yscale="log",
        title="Torque–stiffness workspace",
    )
    if sheet.torque_speed:
        speed, most = np.array(sheet.torque_speed).T
        speeds.fill_between(speed, most, alpha=0.4)
    speeds.set(
        xlabel="Speed [rad/s]",
        ylabel="Torque [N·m]",
        title="Torque–speed workspace" if sheet.torque_speed else "No speed limit is stated",
    )
    text = "\n".join(
        (
            "Measured on the simulated plant, which has no motor voltage:",
            "the speed limit is that of the actuator's file.",
            "",
            "Assumed, without a published source:",
            *sheet.assumed,
        )
    )
    notes.text(0.0, 1.0, text, va="top", fontsize=7).set_in_layout(False)
    compared = [
        f"{quantity}: {fill(f'{value}; published {stated} ({source}); deviation {deviation}', 100)}"
        for quantity, value, stated, deviation, source in list_published(sheet)
    ]
    lines = ["Published figures:", "", *(compared or ["none with a source is known"])]
    published.text(0.0, 1.0, "\n".join(lines), va="top", fontsize=7).set_in_layout(False)
    return page
