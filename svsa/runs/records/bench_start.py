"""The start state of a bench's run, in a separate file of its record.

With it, and the samples as they were measured and sent, every other number of the run can be worked
out again.
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

    mu0: lever ratio at the zero marks. latency_s, lag_s: from a torque that is decided to one that
    acts. torque_step_nm: of both motors, of the least step of current that their drives know.
    motion: what the first tick found, as `BenchLoop.read_motion` returns it. commands: how many of
    the record's commands were given before it began.
    """

    mu0: float
    latency_s: float
    lag_s: float
    torque_step_nm: tuple[float, float]
    motion: dict[str, list[float]]
    commands: int


_START = TypeAdapter(BenchStart)


def write_start(folder: Path, start: BenchStart) -> None:
    """Write the start state; raises `OSError`."""
    replace_file(folder / START_FILE, dump_start(start))


def dump_start(start: BenchStart) -> bytes:
    """Convert the start state to JSON."""
    return _START.dump_json(start)


def read_start(folder: Path) -> BenchStart | None:
    """Read the start state; None for a simulated run, and if it was not written.

    Raises `RecordError` where the file is damaged.
    """
    try:
        start = _START.validate_json((folder / START_FILE).read_bytes())
        return replace(start, motion=translate_fields(start.motion, MOTION))
    except FileNotFoundError:
        return None
    except (OSError, ValidationError) as error:
        raise RecordError(f"{START_FILE} of record {folder.name} is damaged: {error}") from None
