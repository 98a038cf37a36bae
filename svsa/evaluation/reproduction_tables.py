"""The tables of `svsa reproduce`."""

from collections.abc import Sequence

from rich.table import Table

from svsa.control.installed import get_title
from svsa.evaluation.reproduction import Reproduction

_POSITION = ("rms 1–5 s", "peak 5–7 s", "rms 8–20 s", "recovery")
_STIFFNESS = ("rms 1–5 s", "peak 5–7 s", "rms 8–20 s", "peak |u1|", "peak |u2|")


def build_tables(runs: Sequence[Reproduction]) -> list[Table]:
    """Position error in one table, stiffness error and torque in the other: 80 columns each."""
    position = _start_table("Position error [°]", _POSITION)
    stiffness = _start_table("Stiffness error [N·m/rad], torque [N·m]", _STIFFNESS)
    for run in runs:
        n, row = run.numbers, (run.figure.upper(), get_title(run.law))
        recovery = f"{n['recovery_s']:.2f} s" if n["recovery_s"] is not None else "never"
        position.add_row(
            *row,
            f"{n['rms_position_before_deg']:.4f}",
            f"{n['peak_position_deg']:.2f}",
            f"{n['rms_position_steady_deg']:.4f}",
            recovery,
        )
        stiffness.add_row(
            *row,
            f"{n['rms_stiffness_before_nm_per_rad']:.4f}",
            f"{n['peak_stiffness_nm_per_rad']:.4f}",
            f"{n['rms_stiffness_steady_nm_per_rad']:.4f}",
            *(f"{torque:.1f}" for torque in n["peak_torque_nm"]),
        )
    return [position, stiffness]


def _start_table(title: str, columns: tuple[str, ...]) -> Table:
    table = Table("Figure", "law", title=title, title_justify="left")
    for column in columns:
        table.add_column(column, justify="right")
    return table
