"""Identification from any measurement: a recorded run, a simulated result, or a CSV file."""

import re
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import numpy as np

from svsa.actuators.lever import compute_lever_ratio_slope
from svsa.analysis.identification.fit import Progress
from svsa.analysis.identification.identify import (
    Identification,
    identify_evidence,
)
from svsa.analysis.identification.identify import identify as identify_record
from svsa.analysis.identification.initial_guess import guess_noise
from svsa.analysis.identification.record import (
    MIN_SEGMENTS,
    SEGMENT_S,
    Evidence,
    IdentificationError,
    build_setting,
    build_torques,
    check_actuator,
    find_segments,
)
from svsa.errors import ParameterError, Violation
from svsa.inputs import arrow as pa
from svsa.inputs.checked import check_number
from svsa.runs.definition.design import Design
from svsa.runs.definition.experiment import build_experiment
from svsa.runs.result.recorded import find_record
from svsa.simulation.reference.series_csv import CSV_FORMAT

if TYPE_CHECKING:
    from svsa.runs.result.result import Result

TIME = "time_s"
ANGLES = ("motor1_position", "motor2_position", "deflection")
TORQUES = ("torque1_nm", "torque2_nm")
UNITS = {"_rad": 1.0, "_deg": np.pi / 180.0}
LONGEST_PERIOD_S = 0.01
JITTER = 0.01
NUMBER = r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?"


def identify(
    source: "Path | str | Result",
    *,
    parameters: Design | Path | str | None = None,
    stiffness_nm_per_rad: float | None = None,
    progress: Progress = lambda _: None,
) -> Identification:
    """Estimate inertias, dampings, spring and friction of the actuator by output error.

    A CSV file has a header with `time_s`, `motor1_position_rad`, `motor2_position_rad`,
    `deflection_rad` (or `_deg` each), `torque1_nm` and `torque2_nm`: measured angles and commanded
    torques, at the gearbox outputs, without a load, in equal steps of at most 10 ms.

    Args:
        source: Id or folder of a recorded run, a simulated result, or a CSV file (`.csv`).
        parameters: For a CSV file: parameter file or `Design` with the known radius and γ, and a
            spring within a factor of two of the true one; default: those of the paper.
        stiffness_nm_per_rad: For a CSV file: known stiffness without deflection in its first row,
            N·m/rad. The lever ratio follows from it and from the estimated spring.
        progress: Called with the finished share, 0 to 1.

    Returns:
        Estimates with 95 % intervals; `build_design()` converts them to parameters.

    Raises:
        ParameterError: If the file cannot be read; the message has column, value and bound.
        IdentificationError: If the measurement cannot be used.
    """
    if not (isinstance(source, (str, Path)) and str(source).lower().endswith(".csv")):
        return identify_record(find_record(source), progress)
    if stiffness_nm_per_rad is None:
        bound = "given with a CSV file: the stiffness without deflection in its first row"
        raise ParameterError(Violation("stiffness_nm_per_rad", None, "N·m/rad", bound))
    evidence = read_csv_evidence(Path(source), parameters, stiffness_nm_per_rad)
    return identify_evidence(evidence, str(source), progress)


def read_csv_evidence(
    path: Path, parameters: Design | Path | str | None, stiffness_nm_per_rad: float
) -> Evidence:
    """Measured angles and torques of a CSV file; see `identify`."""
    check_number("stiffness_nm_per_rad", stiffness_nm_per_rad, "N·m/rad", 0.1, 1000.0)
    table = _read_table(path)
    time = table[TIME]
    steps = np.diff(time)
    period = float(np.median(steps)) if len(steps) else 0.0
    if not 0.0 < period <= LONGEST_PERIOD_S:
        bound = f"rising, in steps of at most {LONGEST_PERIOD_S:g} s"
        raise ParameterError(Violation(TIME, period, "s", bound), file=str(path))
    worst = int(np.argmax(np.abs(steps - period)))
    if abs(steps[worst] - period) > JITTER * period:
        bound = f"{period:g} s after the row before, as in most rows: interpolate the gap"
        raise ParameterError(
            Violation(f"{TIME} in row {worst + 3}", float(time[worst + 1]), "s", bound),
            file=str(path),
        )
    configuration = build_experiment("4a", parameters, {}, identify)
    check_actuator(configuration, "The parameter file")
    actuator = configuration.actuator
    angles = np.stack([_read_angle(table, name, path) for name in ANGLES], axis=1)
    slope = compute_lever_ratio_slope(actuator.spiral_reduction)
    first = -slope * float(angles[0, 1])
    setting, lag = build_setting(configuration, first, period, stiffness_nm_per_rad)
    torques = build_torques(np.stack([table[name] for name in TORQUES], axis=1), True, lag, period)
    length = round(SEGMENT_S / period)
    segments = find_segments(np.ones(len(time), bool), length)
    if len(segments) < MIN_SEGMENTS:
        raise IdentificationError(
            f"{path} has {len(time) * period:g} s: at least {MIN_SEGMENTS * SEGMENT_S:g} s are"
            " needed."
        )
    evidence = Evidence(configuration, setting, angles, torques, segments, length, 0)
    return evidence._replace(lever_deviation=slope * float(guess_noise(evidence)[1]))


def _read_table(path: Path) -> dict[str, np.ndarray]:
    """The columns of a CSV file as numbers."""
    try:
        table = pa.csv.read_csv(path)
    except (OSError, pa.ArrowInvalid) as error:
        bound = f"a readable CSV file with a header, {CSV_FORMAT} ({error})"
        raise ParameterError(Violation("file", str(path), "", bound)) from None
    needed = (TIME, *(f"{name}_rad" for name in ANGLES), *TORQUES)
    for name in (TIME, *TORQUES):
        if name not in table.column_names:
            bound = f"columns {', '.join(needed)}, {CSV_FORMAT}"
            present = ", ".join(table.column_names)
            raise ParameterError(Violation("the head", present, "", bound), file=str(path))
    columns = {}
    for name in table.column_names:
        try:
            columns[name] = table[name].cast(pa.float64()).to_numpy()
        except (pa.ArrowInvalid, pa.ArrowNotImplementedError):
            if name in (TIME, *TORQUES) or name.rpartition("_")[0] in ANGLES:
                _reject_text(name, table[name], path)
    for name, values in columns.items():
        if not np.isfinite(values).all():
            row = int(np.argmin(np.isfinite(values))) + 2
            bound = "a number in every row"
            raise ParameterError(Violation(f"{name} in row {row}", None, "", bound), file=str(path))
    return columns


def _reject_text(name: str, cells: "pa.ChunkedArray", path: Path) -> NoReturn:
    """Report the first cell that is not a number."""
    texts = enumerate(map(str, cells.to_pylist()))
    row, text = next((row, text) for row, text in texts if not re.fullmatch(NUMBER, text))
    bound = f"a number in every row, {CSV_FORMAT}"
    raise ParameterError(Violation(f"{name} in row {row + 2}", text, "", bound), file=str(path))


def _read_angle(table: dict[str, np.ndarray], name: str, path: Path) -> np.ndarray:
    """An angle, rad."""
    for unit, factor in UNITS.items():
        if name + unit in table:
            return factor * table[name + unit]
    bound = f"{name}_rad or {name}_deg"
    raise ParameterError(Violation("the head", ", ".join(table), "", bound), file=str(path))
