"""The fault that a recorded run ended in: a file of its own in the record, where there is one."""

from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from svsa.errors import Fault
from svsa.runs.records.header import RecordError, replace_file

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
    """The fault that the run ended in; None where it ended otherwise, and where nobody wrote it.

    Raises `RecordError` where the file is damaged.
    """
    try:
        return _FAULT.validate_json((folder / FAULT_FILE).read_bytes())
    except FileNotFoundError:
        return None
    except (OSError, ValidationError) as error:
        raise RecordError(f"{FAULT_FILE} of record {folder.name} is damaged: {error}") from None
