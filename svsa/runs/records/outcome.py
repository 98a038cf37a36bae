"""The bench's events and the fault of a recorded run, each a file of its record."""

from collections.abc import Sequence
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from svsa.errors import Fault
from svsa.runs.events import Event
from svsa.runs.records.header import RecordError, replace_file

EVENTS_FILE = "events.json"
_EVENTS = TypeAdapter(tuple[Event, ...])


def write_events(folder: Path, events: Sequence[Event]) -> None:
    """Write the reported events, in the order of time; raises `OSError`."""
    replace_file(folder / EVENTS_FILE, dump_events(events))


def dump_events(events: Sequence[Event]) -> bytes:
    """The events as JSON."""
    return _EVENTS.dump_json(tuple(events))


def read_events(folder: Path) -> tuple[Event, ...]:
    """The reported events; none if none were written, as by an older version.

    Raises `RecordError` where the file is damaged.
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
    """Say that the run ended in this fault, or in none; raises `OSError`."""
    if fault is None:
        (folder / FAULT_FILE).unlink(missing_ok=True)
    else:
        replace_file(folder / FAULT_FILE, dump_fault(fault))


def dump_fault(fault: Fault) -> bytes:
    """The fault as JSON."""
    return _FAULT.dump_json(fault)


def read_fault(folder: Path) -> Fault | None:
    """The fault that the run ended in; None if it ended otherwise, or if it was not written.

    Raises `RecordError` where the file is damaged.
    """
    try:
        return _FAULT.validate_json((folder / FAULT_FILE).read_bytes())
    except FileNotFoundError:
        return None
    except (OSError, ValidationError) as error:
        raise RecordError(f"{FAULT_FILE} of record {folder.name} is damaged: {error}") from None
