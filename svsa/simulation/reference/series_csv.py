"""Time series from CSV: a column of times and one of angles or stiffness, named in the header.

time_s,position_deg          or position_rad, or stiffness_nm_per_rad
0,0
0.5,30
"""

import csv
import io
import math
from pathlib import Path
from typing import NamedTuple

from svsa.errors import ParameterError, Violation
from svsa.simulation.reference.curve import Points, check_curve
from svsa.simulation.reference.kinds.series import (
    MAX_ROWS,
    SeriesPosition,
    SeriesStiffness,
    build_spline,
)
from svsa.simulation.reference.shape import FASTEST_POSITION, FASTEST_STIFFNESS, FULL_TURN_RAD

TIME = "time_s"
CSV_FORMAT = "cells separated by a comma, numbers with a decimal point"
"""As spreadsheets write it with English number formats."""


class Column(NamedTuple):
    """A column of values.

    Attributes:
        unit: Unit of the column.
        factor: The size of this unit in the unit of the reference.
        least: Smallest value, in the unit of the reference.
        bounds: Bounds of the orders 0, 1, …, in the unit of the reference.
    """

    unit: str
    factor: float
    least: float
    bounds: tuple[float, ...]


COLUMNS = {
    "position_rad": Column("rad", 1.0, -FULL_TURN_RAD, FASTEST_POSITION),
    "position_deg": Column("deg", math.radians(1.0), -FULL_TURN_RAD, FASTEST_POSITION),
    "stiffness_nm_per_rad": Column("N·m/rad", 1.0, 1e-3, FASTEST_STIFFNESS),
}


def read_series(path: Path | str) -> SeriesPosition | SeriesStiffness:
    """Read a reference from a CSV file; see `parse_series` for the columns.

    Args:
        path: The file: a column of times, s, and one of positions, rad, or of stiffness, N·m/rad.

    Returns:
        The reference defined by the columns.

    Raises:
        ParameterError: If the file cannot be read, or a column or value is invalid.
    """
    try:
        text = Path(path).read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        bound = f"a readable CSV file in UTF-8 ({error})"
        raise ParameterError(Violation("file", path, "", bound)) from None
    return parse_series(text)


def parse_series(text: str) -> SeriesPosition | SeriesStiffness:
    """Parse the reference in a CSV text; the name of the column defines quantity and unit.

    Raises:
        ParameterError: If a row is invalid; the message has row (the header is row 1), value, unit
            and bound.
    """
    lines = csv.reader(io.StringIO(text.removeprefix("\ufeff"), newline=""))
    try:
        rows = [(lines.line_num, row) for row in lines if any(cell.strip() for cell in row)]
    except csv.Error as error:
        found = f"{error} in row {lines.line_num + 1}"
        raise ParameterError(
            Violation("the CSV", text[:80], "", "a table", finding=found)
        ) from None
    head = [cell.strip() for cell in rows[0][1]] if rows else []
    names = [name for name in head if name in COLUMNS]
    if len(head) != 2 or TIME not in head or len(names) != 1:
        bound = f"{TIME} and one of {', '.join(COLUMNS)}; {CSV_FORMAT}"
        raise ParameterError(Violation("the head of the CSV", ",".join(head), "", bound))
    name, count = names[0], len(rows) - 1
    if not 2 <= count <= MAX_ROWS:
        bound = f"from 2 to {MAX_ROWS} below the header"
        raise ParameterError(Violation("the number of rows", count, "", bound))

    def place(name: str, number: int) -> str:
        return f"{name} in row {rows[number + 1][0]}"

    times, values = (
        tuple(
            _read_cell(row, head.index(key), place(key, number), unit)
            for number, (_, row) in enumerate(rows[1:])
        )
        for key, unit in ((TIME, "s"), (name, COLUMNS[name].unit))
    )
    return _build(Points(name, COLUMNS[name].unit, times, values, place))


def _build(points: Points) -> SeriesPosition | SeriesStiffness:
    """Build the reference; values are checked first in the unit of the file."""
    name, unit, times, values, place = points
    _, factor, lowest, bounds = COLUMNS[name]
    least, most = lowest / factor, bounds[0] / factor
    for number, value in enumerate(values):
        if not least <= value <= most:
            bound = f"from {least:g} to {most:g} {unit}"
            raise ParameterError(Violation(place(name, number), value, unit, bound))
    # The values are within the bounds already; the conversion may round one just beyond.
    si = tuple(min(max(value * factor, lowest), bounds[0]) for value in values)
    check_curve(name, build_spline(points._replace(values=si)), unit, factor, bounds)
    if name == "stiffness_nm_per_rad":
        return SeriesStiffness(time_s=times, stiffness_nm_per_rad=si)
    return SeriesPosition(time_s=times, position_rad=si)


def _read_cell(row: list[str], index: int, place: str, unit: str) -> float:
    if len(row) != 2:
        raise ParameterError(Violation(place, ",".join(row), "", f"one of two cells; {CSV_FORMAT}"))
    try:
        value = math.nan if "_" in row[index] else float(row[index])
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        bound = "a finite number with a decimal point"
        raise ParameterError(Violation(place, row[index].strip(), unit, bound))
    return value
