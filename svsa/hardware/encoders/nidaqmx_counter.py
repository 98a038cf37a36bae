"""An encoder at a counter of an NI card, such as the paper's PCI-6259, read on demand.

`pip install 'svsa-lab[nidaqmx]'` and NI's driver are required; both are loaded at `open` only.
"""

import math
from typing import Any

import can

from svsa.hardware.encoders.source import EncoderError
from svsa.inputs.checked import Checked, Whole, quantity
from svsa.inputs.extras import MissingExtraError, require_extra

_EDGES = 4
_READ_TIMEOUT_S = 0.001


class CounterSettings(Checked):
    """The counter, and the encoder's lines."""

    counter: str = quantity("", "Counter, such as Dev1/ctr0")
    lines: Whole = quantity("1", "Lines (pulses) per revolution, before quadrature", ge=1, le=10**7)
    a_terminal: str | None = quantity("", "Input of signal A, if not the default one", default=None)
    b_terminal: str | None = quantity("", "Input of signal B, if not the default one", default=None)


class NidaqmxCounter:
    """Counts of all edges (X4) by an angle-encoder channel, one read on demand each tick."""

    bits = 32

    def __init__(self, settings: CounterSettings) -> None:
        self._settings = settings
        self._counts_a_rad = settings.lines * _EDGES / (2.0 * math.pi)
        self._task: Any = None
        self._failure: type[Exception] = OSError

    def open(self) -> None:
        """Start the counter at zero.

        Raises:
            EncoderError: If something is missing, with its name.
        """
        try:
            require_extra("nidaqmx")
        except MissingExtraError as error:
            raise EncoderError(f"The deflection encoder's source: {error}") from None
        import nidaqmx
        from nidaqmx.constants import AngleUnits, EncoderType
        from nidaqmx.errors import Error

        s, self._failure = self._settings, Error
        try:
            self._task = nidaqmx.Task()
            channel = self._task.ci_channels.add_ci_ang_encoder_chan(
                s.counter,
                decoding_type=EncoderType.X_4,
                units=AngleUnits.RADIANS,
                pulses_per_rev=s.lines,
            )
            if s.a_terminal is not None:
                channel.ci_encoder_a_input_term = s.a_terminal
            if s.b_terminal is not None:
                channel.ci_encoder_b_input_term = s.b_terminal
            self._task.start()
        except Error as error:
            self.close()
            raise EncoderError(
                f"The counter {s.counter} cannot be used: {str(error).strip('. ')}. Check that NI's"
                " driver is installed, the card is seen by it, and the counter's name."
            ) from None

    def feed(self, message: can.Message, time_s: float) -> bool:
        """No frame of the bus is this encoder's."""
        return False

    def read(self, now_s: float) -> tuple[int, float] | None:
        """Read the current counts.

        Raises:
            EncoderError: If the card does not answer.
        """
        if self._task is None:
            return None
        try:
            angle = self._task.read(timeout=_READ_TIMEOUT_S)
        except self._failure as error:
            raise EncoderError(f"The deflection encoder's counter failed: {error}.") from None
        return round(angle * self._counts_a_rad), now_s

    def close(self) -> None:
        """Release the counter."""
        if self._task is not None:
            self._task.close()
            self._task = None
