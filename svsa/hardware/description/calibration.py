"""The calibration record of a bench: signs, scales and zero counts, with date and name.

It is stored next to the bench file, as NAME.calibration.toml, and is valid for that bench file
only: it contains a fingerprint of the motors, the deflection encoder and the home marks. Without a
valid record the bench cannot be armed.
"""

import hashlib
import json
from datetime import datetime
from pathlib import Path

import tomli_w

from svsa.errors import ParameterError, Violation
from svsa.hardware.bench.settings import DEFAULT_DRIVE
from svsa.hardware.description.file import BenchFile
from svsa.inputs.checked import Checked, Flag, Whole, quantity
from svsa.inputs.toml_file import read_toml

SUFFIX = ".calibration.toml"


class Calibration(Checked):
    """Date, name and results. The zero counts hold at the zero marks."""

    date: str = quantity("", "Time, ISO 8601 with its zone")
    by: str = quantity("", "Author", min_length=1, max_length=100)
    fingerprint: str = quantity("", "Fingerprint of the bench file of the calibration")
    deflection_zero_counts: Whole = quantity("counts", "Counts of the deflection encoder at φ = 0")
    signs_confirmed: Flag = quantity("", "Whether every sign was confirmed")


def compute_fingerprint(bench: BenchFile) -> str:
    """Compute a fingerprint of everything a calibration depends on: motors, encoder, home marks."""
    parts = bench.model_dump(mode="json", include={"motor1", "motor2", "deflection", "home"})
    for motor in (parts["motor1"], parts["motor2"]):
        # Calibrations of earlier versions, which had one family of drives, stay valid.
        if motor["drive"] == DEFAULT_DRIVE:
            del motor["drive"]
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()[:16]


def get_calibration_path(bench: BenchFile) -> Path:
    """Return the path of the bench's record."""
    path = Path(bench.path)
    return path.with_name(path.stem + SUFFIX)


def find_calibration(bench: BenchFile) -> Calibration | None:
    """Return the record next to the bench file, or None.

    Raises:
        ParameterError: If it is damaged.
    """
    path = get_calibration_path(bench)
    if not path.exists():
        return None
    calibration = Calibration(**read_toml(path, "calibration record"))
    try:
        zoned = datetime.fromisoformat(calibration.date).tzinfo is not None
    except ValueError:
        zoned = False
    if not zoned:
        bound = "a time of ISO 8601 with its zone, as 2026-01-02T03:04:05+00:00"
        raise ParameterError(Violation("date", calibration.date, "", bound))
    return calibration


def write_calibration(bench: BenchFile, calibration: Calibration) -> Path:
    """Write the record next to the bench file and return its path; an older one is replaced."""
    path = get_calibration_path(bench)
    draft = path.with_suffix(".tmp")
    draft.write_text(tomli_w.dumps(calibration.model_dump(mode="json")), encoding="utf-8")
    draft.replace(path)
    return path


def note_signs(bench: BenchFile, right: bool) -> None:
    """Store in the record of this bench whether its signs were confirmed.

    Does nothing without a record, or with one for other settings.
    """
    calibration = find_calibration(bench)
    if calibration is not None and calibration.fingerprint == compute_fingerprint(bench):
        write_calibration(bench, calibration.changed(signs_confirmed=right))


def list_problems(bench: BenchFile, calibration: Calibration | None) -> list[str]:
    """List the reasons why this bench cannot be armed; empty if it can."""
    problems = [f"uncalibrated: {missing}" for missing in bench.find_missing()]
    if calibration is None:
        problems.append("uncalibrated: there is no calibration record; run `svsa bench-home`")
    elif calibration.fingerprint != compute_fingerprint(bench):
        problems.append(
            "uncalibrated: motors, encoder or home marks in the bench file were changed after"
            f" the calibration of {calibration.date[:10]}; run `svsa bench-home` again"
        )
    elif not calibration.signs_confirmed:
        problems.append("uncalibrated: the signs were not confirmed; run `svsa bench-check --move`")
    return problems
