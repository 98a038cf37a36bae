"""The start state of a bench's run, in a separate file of its record.

From it, and the measured and sent values in the samples, all other numbers of the run can be
reproduced.
"""

from dataclasses import dataclass, replace
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from svsa.runs.records.former_words import MOTION, translate_fields
from svsa.runs.records.header import RecordError, replace_file

START_FILE = "bench-start.json"


@dataclass(frozen=True)
class BenchStart:
    """The start values of a bench's run that its samples do not contain.

    Attributes:
        mu0: Lever ratio at the zero marks, 1.
        latency_s: Time from the decision about a torque to its effect, s.
        lag_s: Time constant of the current loop, s.
        torque_step_nm: Torque of the smallest current step of both drives, N·m.
        motion: State of the loop at the first tick, as `BenchLoop.read_motion` returns it.
        commands: Number of the record's commands that were given before the run began.
    """

    mu0: float
    latency_s: float
    lag_s: float
    torque_step_nm: tuple[float, float]
    motion: dict[str, list[float]]
    commands: int


_START = TypeAdapter(BenchStart)


def write_start(folder: Path, start: BenchStart) -> None:
    """Write the start state.

    Raises:
        OSError: If the file cannot be written.
    """
    replace_file(folder / START_FILE, dump_start(start))


def dump_start(start: BenchStart) -> bytes:
    """Convert the start state to JSON."""
    return _START.dump_json(start)


def read_start(folder: Path) -> BenchStart | None:
    """Read the start state; None for a simulated run, and if it was not written.

    Raises:
        RecordError: If the file is damaged.
    """
    try:
        start = _START.validate_json((folder / START_FILE).read_bytes())
        return replace(start, motion=translate_fields(start.motion, MOTION))
    except FileNotFoundError:
        return None
    except (OSError, ValidationError) as error:
        raise RecordError(f"{START_FILE} of record {folder.name} is damaged: {error}") from None
