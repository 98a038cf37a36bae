"""The ranking's table as text: one row a law, as measured."""

from collections.abc import Iterable, Sequence

from svsa.control.installed import get_title
from svsa.evaluation.ranking.row import Row

HEADINGS = (
    "law",
    "score",
    "4A ideal: before / peak / steady",
    "4A rig: peak / steady / recovery s",
    "unloading",
    "faults of 48",
    "settled, worst of 48",
    "2 Hz",
    "3 kg",
    "draws: median / faults / fails",
    "largest step N·m",
)


def build_cells(row: Row) -> tuple[str, ...]:
    """The cells of a row, errors in degrees.

    Where a run ended early its fault stands; "never" where an error did not settle.
    """
    ideal, rig, faults = row.ideal_4a, row.rig_4a, row.faults

    def tell(name: str, numbers: Sequence[float | None]) -> str:
        if name in faults:
            return faults[name]
        return " / ".join("never" if number is None else f"{number:.3g}" for number in numbers)

    return (
        get_title(row.law),
        f"{row.score:.2f}",
        tell("ideal_4a", (ideal.before_deg, ideal.peak_deg, ideal.steady_deg)),
        tell("rig_4a", (rig.peak_deg, rig.steady_deg, rig.recovery_s)),
        tell("unloading", (row.unloading_peak_deg,)),
        str(row.unloading_faults_of_48),
        _tell_or_fault(row.unloading_settled_deg),
        tell("sine_2hz", (row.sine_2hz_rms_deg,)),
        tell("mass", (row.mass_rms_deg,)),
        f"{_tell_or_fault(row.draws_median_deg)} / {row.draws_faults} / {row.draws_fails}",
        f"{row.largest_link_step_nm:g}",
    )


def _tell_or_fault(number: float | None) -> str:
    return "fault" if number is None else f"{number:.3g}"


SHORT = (
    "law", "score", "ideal", "peak", "settled", "recov.", "unload", "of 48", "worst", "2 Hz",
    "3 kg", "draws", "fails", "step",
)  # fmt: skip
"""Of the table on a terminal: 4A ideal settled; on the rig peak, settled, recovery in s."""


def build_short_cells(row: Row) -> tuple[str, ...]:
    """As `build_cells`, a number a column; "fault" where a run ended early."""

    def tell(number: float | None, scenario: str = "") -> str:
        if number is not None:
            return f"{number:.2g}" if number < 1.0 else f"{number:.3g}"
        return "fault" if scenario in row.faults or not scenario else "never"

    return (
        get_title(row.law),
        f"{row.score:.2f}",
        tell(row.ideal_4a.steady_deg, "ideal_4a"),
        tell(row.rig_4a.peak_deg, "rig_4a"),
        tell(row.rig_4a.steady_deg, "rig_4a"),
        tell(row.rig_4a.recovery_s, "rig_4a"),
        tell(row.unloading_peak_deg, "unloading"),
        str(row.unloading_faults_of_48),
        tell(row.unloading_settled_deg),
        tell(row.sine_2hz_rms_deg, "sine_2hz"),
        tell(row.mass_rms_deg, "mass"),
        tell(row.draws_median_deg),
        str(row.draws_fails),
        f"{row.largest_link_step_nm:g}",
    )


def format_markdown(rows: Iterable[Row]) -> str:
    """The table as Markdown."""
    lines = [HEADINGS, ("---",) * len(HEADINGS), *map(build_cells, rows)]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)
