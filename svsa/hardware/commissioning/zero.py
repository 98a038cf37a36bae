"""The zero of the deflection encoder, read while the spring is relaxed."""

import time
from datetime import datetime
from pathlib import Path

import numpy as np

from svsa.errors import StateError
from svsa.hardware.bench.homing import Homing
from svsa.hardware.bench.settings import AXIS_WORDS
from svsa.hardware.commissioning.probe import BusOpener, Clock, Probe
from svsa.hardware.description.calibration import (
    Calibration,
    compute_fingerprint,
    find_calibration,
    write_calibration,
)
from svsa.hardware.description.file import BenchFile
from svsa.hardware.drives.bus import open_bus
from svsa.hardware.encoders.source import EncoderError

LISTEN_S = 0.5
STILL_COUNTS = 2


def calibrate(
    bench: BenchFile, homing: Homing, opener: BusOpener = open_bus, now: Clock = time.monotonic
) -> tuple[Path, Calibration]:
    """Read the zero and write the record; confirmed signs of this bench are kept.

    An older record is replaced.

    Raises:
        StateError: While a mark is unconfirmed or the deflection moves.
        BusError: If the bus cannot be read.
        EncoderError: If the encoder cannot be read.
    """
    if homing.next_step is not None:
        axis = AXIS_WORDS[homing.next_step].capitalize()
        raise StateError(f"{axis} has not been confirmed at its zero mark yet.")
    zero = read_deflection_zero(bench, opener, now)
    before = find_calibration(bench)
    fingerprint = compute_fingerprint(bench)
    calibration = Calibration(
        date=datetime.now().astimezone().isoformat(timespec="seconds"),
        by=homing.confirmed["link"].strip(),
        fingerprint=fingerprint,
        deflection_zero_counts=zero,
        signs_confirmed=bool(
            before and before.signs_confirmed and before.fingerprint == fingerprint
        ),
    )
    return write_calibration(bench, calibration), calibration


def read_deflection_zero(
    bench: BenchFile, opener: BusOpener = open_bus, now: Clock = time.monotonic
) -> int:
    """The counts of the deflection encoder at rest, median of half a second."""
    probe = Probe(bench, opener, now)
    try:
        probe.open()
        counts = [reading.counts for reading in probe.listen(LISTEN_S).deflection]
    finally:
        probe.close()
    if probe.encoder_failure is not None:
        raise EncoderError(probe.encoder_failure)
    if not counts:
        raise EncoderError(
            f"The deflection encoder sent nothing for {LISTEN_S:g} s: run `svsa bench-check`."
        )
    if max(counts) - min(counts) > STILL_COUNTS:
        raise StateError(
            f"The deflection moved by {max(counts) - min(counts)} counts while its zero was read:"
            " release the link, wait until it is still, and start again."
        )
    return int(np.median(counts))
