"""Events of a bench and the fault of a recorded run, one file each."""

from collections.abc import Sequence
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from svsa.errors import Fault
from svsa.runs.records.header import RecordError, replace_file
from svsa.runs.timeline.events import Event

EVENTS_FILE = "events.json"
_EVENTS = TypeAdapter(tuple[Event, ...])


def write_events(folder: Path, events: Sequence[Event]) -> None:
    """Write the reported events in order of time.

    Raises:
        OSError: If the file cannot be written.
    """
    replace_file(folder / EVENTS_FILE, dump_events(events))


def dump_events(events: Sequence[Event]) -> bytes:
    """Convert the events to JSON."""
    return _EVENTS.dump_json(tuple(events))


def read_events(folder: Path) -> tuple[Event, ...]:
    """Read the reported events; empty without a file, as in records of older versions.

    Raises:
        RecordError: If the file is damaged.
    """
    try:
        return _EVENTS.validate_json((folder / EVENTS_FILE).read_bytes())
    except FileNotFoundError:
        return ()
    except (OSError, ValidationError) as error:
        raise RecordError(f"{EVENTS_FILE} of record {folder.name} is damaged: {error}") from None


FAULT_FILE = "fault.json"
_FAULT = TypeAdapter(Fault)


def write_fault(folder: Path, fault: Fault | None) -> None:
    """Write the fault of a run, or that it had none.

    Raises:
        OSError: If the file cannot be written.
    """
    if fault is None:
        (folder / FAULT_FILE).unlink(missing_ok=True)
    else:
        replace_file(folder / FAULT_FILE, dump_fault(fault))


def dump_fault(fault: Fault) -> bytes:
    """Convert the fault to JSON."""
    return _FAULT.dump_json(fault)


def read_fault(folder: Path) -> Fault | None:
    """Read the fault of a run; None if there was none or it was not written.

    Raises:
        RecordError: If the file is damaged.
    """
    try:
        return _FAULT.validate_json((folder / FAULT_FILE).read_bytes())
    except FileNotFoundError:
        return None
    except (OSError, ValidationError) as error:
        raise RecordError(f"{FAULT_FILE} of record {folder.name} is damaged: {error}") from None
