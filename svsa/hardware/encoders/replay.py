"""Counts from a file, to test a bench without its encoder."""

from pathlib import Path

import can
import numpy as np

from svsa.hardware.encoders.source import EncoderError
from svsa.inputs.checked import Checked, quantity


class ReplaySettings(Checked):
    """The file: CSV with a row "time_s,counts" per reading, times increasing from 0."""

    file: str = quantity("", "CSV file of readings")


class Replay:
    """The readings of a file, from the first call of `read` on; the last one is repeated."""

    bits = 32

    def __init__(self, settings: ReplaySettings) -> None:
        self._path = Path(settings.file)
        self._times = np.zeros(0)
        self._counts = np.zeros(0, np.int64)
        self._start: float | None = None

    def open(self) -> None:
        """Read the file.

        Raises:
            EncoderError: If it is not readable.
        """
        try:
            rows = np.loadtxt(self._path, delimiter=",", skiprows=1, ndmin=2)
            self._times, counts = rows.T
            self._counts = counts.astype(np.int64)
        except (OSError, ValueError) as error:
            raise EncoderError(f"{self._path} cannot be replayed: {error}.") from None
        if np.any(self._counts != counts):
            raise EncoderError(f"{self._path} cannot be replayed: its counts must be integers.")
        if not len(self._times) or np.any(np.diff(self._times) <= 0.0):
            raise EncoderError(f"{self._path} cannot be replayed: its times must increase.")
        self._start = None

    def feed(self, message: can.Message, time_s: float) -> bool:
        """No frame of the bus is this encoder's."""
        return False

    def read(self, now_s: float) -> tuple[int, float] | None:
        """Return the reading of the time since the first call, as if it were new."""
        if self._start is None:
            self._start = now_s
        place = int(np.searchsorted(self._times, now_s - self._start, side="right")) - 1
        return (int(self._counts[max(place, 0)]), now_s) if len(self._counts) else None

    def close(self) -> None:
        """Do nothing."""
