"""Sources of the deflection encoder's counts, one per file."""

from svsa.errors import ParameterError
from svsa.hardware.bench.settings import DeflectionSettings
from svsa.hardware.encoders.source import DeflectionSource


def read_source(settings: DeflectionSettings) -> DeflectionSource:
    """Build the source in the bench file, not yet open.

    Raises:
        ParameterError: If its options are invalid.
    """
    try:
        return _build_source(settings)
    except ParameterError as error:
        raise error.within("deflection.options") from None


def _build_source(settings: DeflectionSettings) -> DeflectionSource:
    match settings.source:
        case "can":
            from svsa.hardware.encoders.can_node import CanNode, CanNodeSettings

            return CanNode(CanNodeSettings(**settings.options))
        case "serial":
            from svsa.hardware.encoders.serial_line import SerialLine, SerialLineSettings

            return SerialLine(SerialLineSettings(**settings.options))
        case "nidaqmx":
            from svsa.hardware.encoders.nidaqmx_counter import CounterSettings, NidaqmxCounter

            return NidaqmxCounter(CounterSettings(**settings.options))
        case "replay":
            from svsa.hardware.encoders.replay import Replay, ReplaySettings

            return Replay(ReplaySettings(**settings.options))
