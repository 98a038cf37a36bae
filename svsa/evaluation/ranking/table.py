"""The ranking's table as text: one row a law, as measured."""

from collections.abc import Iterable, Sequence

from svsa.control.installed import get_title
from svsa.evaluation.ranking.row import Row

HEADINGS = (
    "law",
    "score",
    "4A ideal: before / peak / steady",
    "4A rig: peak / steady / recovery s",
    "load removal",
    "faults of 48",
    "settled, worst of 48",
    "2 Hz",
    "3 kg",
    "trials: median / faults / fails",
    "largest step N·m",
)


def build_cells(row: Row) -> tuple[str, ...]:
    """The cells of a row, errors in degrees.

    Where a run ended early its fault stands; "never" where an error did not settle.
    """
    ideal, rig, faults = row.ideal_4a, row.rig_4a, row.faults

    def format_cell(name: str, numbers: Sequence[float | None]) -> str:
        if name in faults:
            return faults[name]
        return " / ".join("never" if number is None else f"{number:.3g}" for number in numbers)

    return (
        get_title(row.law),
        f"{row.score:.2f}",
        format_cell("ideal_4a", (ideal.before_deg, ideal.peak_deg, ideal.steady_deg)),
        format_cell("rig_4a", (rig.peak_deg, rig.steady_deg, rig.recovery_s)),
        format_cell("load_removal", (row.load_removal_peak_deg,)),
        str(row.load_removal_faults_of_48),
        _format_or_fault(row.load_removal_steady_state_deg),
        format_cell("sine_2hz", (row.sine_2hz_rms_deg,)),
        format_cell("mass", (row.mass_rms_deg,)),
        f"{_format_or_fault(row.trials_median_deg)} / {row.trials_faults} / {row.trials_fails}",
        f"{row.largest_link_step_nm:g}",
    )


def _format_or_fault(number: float | None) -> str:
    return "fault" if number is None else f"{number:.3g}"


SHORT = (
    "law", "score", "ideal", "peak", "settled", "recov.", "unload", "of 48", "worst", "2 Hz",
    "3 kg", "trials", "fails", "step",
)  # fmt: skip
"""Of the table on a terminal: 4A ideal settled; on the rig peak, settled, recovery in s."""


def build_short_cells(row: Row) -> tuple[str, ...]:
    """As `build_cells`, a number a column; "fault" where a run ended early."""

    def format_cell(number: float | None, scenario: str = "") -> str:
        if number is not None:
            return f"{number:.2g}" if number < 1.0 else f"{number:.3g}"
        return "fault" if scenario in row.faults or not scenario else "never"

    return (
        get_title(row.law),
        f"{row.score:.2f}",
        format_cell(row.ideal_4a.steady_deg, "ideal_4a"),
        format_cell(row.rig_4a.peak_deg, "rig_4a"),
        format_cell(row.rig_4a.steady_deg, "rig_4a"),
        format_cell(row.rig_4a.recovery_s, "rig_4a"),
        format_cell(row.load_removal_peak_deg, "load_removal"),
        str(row.load_removal_faults_of_48),
        format_cell(row.load_removal_steady_state_deg),
        format_cell(row.sine_2hz_rms_deg, "sine_2hz"),
        format_cell(row.mass_rms_deg, "mass"),
        format_cell(row.trials_median_deg),
        str(row.trials_fails),
        f"{row.largest_link_step_nm:g}",
    )


def format_markdown(rows: Iterable[Row]) -> str:
    """The table as Markdown."""
    lines = [HEADINGS, ("---",) * len(HEADINGS), *map(build_cells, rows)]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)
