"""What a bench told of itself while its run was recorded: events that no command explains."""

from collections.abc import Sequence
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from svsa.runs.events import Event
from svsa.runs.records.header import RecordError, replace_file

EVENTS_FILE = "events.json"
_EVENTS = TypeAdapter(tuple[Event, ...])


def write_events(folder: Path, events: Sequence[Event]) -> None:
    """Say that these were told, in the order of time; raises `OSError`."""
    replace_file(folder / EVENTS_FILE, dump_events(events))


def dump_events(events: Sequence[Event]) -> bytes:
    """The events as JSON."""
    return _EVENTS.dump_json(tuple(events))


def read_events(folder: Path) -> tuple[Event, ...]:
    """The events that were told; none where nobody wrote any, as an older version did not.

    Raises `RecordError` where the file is damaged.
    """
    try:
        return _EVENTS.validate_json((folder / EVENTS_FILE).read_bytes())
    except FileNotFoundError:
        return ()
    except (OSError, ValidationError) as error:
        raise RecordError(f"{EVENTS_FILE} of record {folder.name} is damaged: {error}") from None
