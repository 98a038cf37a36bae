"""The ranking's table as text: one row per entry."""

from collections.abc import Iterable

from svsa.evaluation.ranking.entry import get_entry_title
from svsa.evaluation.ranking.results import Results
from svsa.evaluation.ranking.row import FamilyOutcome, Row, ScenarioOutcome

FAULT = "fault"
PEAK, RMS, RECOVERY = "peak_position_error_rad", "rms_position_error_rad", "recovery_time_s"
SHARE = "peak_stiffness_error_share"
COLUMNS: tuple[tuple[str, str], ...] = (
    ("rig_4a", "paper's load"),
    ("load_removal", "load removal"),
    ("mass", "3 kg"),
    ("unmodelled", "friction, lag, gravity"),
)
"""Fixed scenarios of the table: peak position error, median / worst, and faults."""
HEADINGS = (
    "rank",
    "law",
    "A: held, 95 %",
    "B: held, 95 %",
    "p against NDOBC",
    *(f"{title}: peak [°] median / worst, faults" for _, title in COLUMNS),
    "largest load [N·m]",
    "torque variation at rest [N·m/s]",
)


def format_success(family: FamilyOutcome) -> str:
    """Format the success rate of a family with its 95 % interval, in per cent."""
    low, high = 100.0 * family.success_low, 100.0 * family.success_high
    return f"{100.0 * family.success:.1f} ({low:.1f}–{high:.1f})"


def format_number(value: float | None, digits: int = 3) -> str:
    """Format a number to `digits` digits; "fault" for None."""
    return FAULT if value is None else f"{value:.{digits}g}"


def format_degrees(value: float | None) -> str:
    """Format an angle, rad, in degrees; "fault" for None."""
    return format_number(None if value is None else value * 57.29577951308232)


def format_fixed(outcome: ScenarioOutcome) -> str:
    """Format median and worst peak of a fixed scenario in degrees, and its faults if any."""
    median, worst = outcome.median[PEAK], outcome.worst_values[PEAK]
    faults = f", {outcome.faults} of {outcome.runs}" if outcome.faults else ""
    return f"{format_degrees(median)} / {format_degrees(worst)}{faults}"


def format_p(value: float | None) -> str:
    """Format a p-value; empty for None."""
    if value is None:
        return ""
    return "< 0.001" if value < 0.001 else f"{value:.2g}"


def build_cells(results: Results, row: Row) -> tuple[str, ...]:
    """Build the cells of a row of the ranking's table, in the order of `HEADINGS`."""
    rank = results.get_rank(row.key)
    return (
        str(rank.rank),
        get_entry_title(row.key),
        *map(format_success, row.families.values()),
        format_p(rank.p_value),
        *(format_fixed(row.get_outcome(name)) for name, _ in COLUMNS),
        f"{row.largest_load_nm:g}",
        format_number(row.noise.variation_nm_per_s),
    )


def format_markdown(results: Results, rows: Iterable[Row] | None = None) -> str:
    """Format the ranking's table as Markdown; without `rows`, all rows of the results."""
    shown = results.rows if rows is None else rows
    lines = [HEADINGS, ("---",) * len(HEADINGS), *(build_cells(results, row) for row in shown)]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)
