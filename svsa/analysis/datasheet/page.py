"""A datasheet as one page: numbers, torque–deflection curves and workspaces."""

import numpy as np
from matplotlib.figure import Figure as Picture

from svsa.analysis.datasheet.measure import Datasheet
from svsa.analysis.datasheet.rows import list_rows


def draw_page(found: Datasheet) -> Picture:
    """Draw the datasheet.

    Args:
        found: Datasheet of an actuator.

    Returns:
        An A4 page.
    """
    page = Picture(figsize=(8.27, 11.69), layout="constrained")
    (numbers, curves), (stiffness, workspace), (notes, empty) = page.subplots(3, 2)
    page.suptitle(f"{found.title}\n{found.source}", fontsize=11)
    for axes in (numbers, notes, empty):
        axes.axis("off")
    table = numbers.table(
        cellText=[[name, value] for name, value in list_rows(found)],
        colWidths=[0.68, 0.58],
        loc="center",
        cellLoc="left",
    )
    table.auto_set_font_size(value=False)
    table.set_fontsize(6.0)
    table.scale(1.0, 1.6)
    for one in found.presets:
        label, deflection = f"σ = {one.stiffness_nm_per_rad:.3g}", np.degrees(one.deflection_rad)
        curves.plot(deflection, one.torque_nm, label=label)
        stiffness.plot(deflection, one.stiffness_at_nm_per_rad, label=label)
    curves.set(xlabel="Deflection [°]", ylabel="Torque [N·m]", title="Presets (σ in N·m/rad)")
    curves.legend(fontsize=7)
    stiffness.set(xlabel="Deflection [°]", ylabel="Stiffness [N·m/rad]", yscale="log")
    torque, least, greatest = np.array(found.torque_stiffness).T
    workspace.fill_between(torque, least, greatest, alpha=0.4)
    workspace.set(
        xlabel="Torque at rest [N·m]",
        ylabel="Stiffness [N·m/rad]",
        yscale="log",
        title="Torque–stiffness workspace",
    )
    text = "\n".join(
        (
            "Measured on the simulated plant. Not contained: maximum speed and the",
            "torque–speed workspace, since the plant has no motor voltage.",
            "",
            "Assumed, without a published source:",
            *found.assumed,
        )
    )
    notes.text(0.0, 1.0, text, va="top", fontsize=7)
    return page
