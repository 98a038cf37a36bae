"""Reconciliation of the catalogue with the folders of the runs after a crash."""

import contextlib
import dataclasses
import functools
import logging
from collections.abc import Iterator
from dataclasses import fields
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from svsa.errors import SvsaError
from svsa.inputs.extras import __version__
from svsa.runs.records.catalogue.damage import describe_readable
from svsa.runs.records.catalogue.database import Database
from svsa.runs.records.catalogue.entry import CatalogueError, RunEntry, UnknownRunError
from svsa.runs.records.header import STREAM_FILE, RecordError, is_run_id, read_header
from svsa.runs.records.measured_window import find_measured_window, measure
from svsa.runs.records.parquet import measure_bytes
from svsa.runs.records.reader import Record, claim, open_record, recover
from svsa.runs.records.settings import describe_settings

CUT_OFF = "The recording was cut off."
GONE = "Its folder is missing."
_log = logging.getLogger("svsa")


def index_runs(database: Database, runs: Path, trash: Path) -> Iterator[tuple[int, int]]:
    """Finish unfinished records, register unknown folders, mark damaged and missing runs.

    A record is not read again if its files have not changed since it was described.

    Yields:
        Numbers of finished and of all records; first (0, total), then after each record.
    """
    known = database.list_known()
    present: set[str] = set()
    waiting: list[tuple[Path, bool, str]] = []
    for folder, deleted in _list_folders(runs, trash):
        present.add(folder.name)
        state, was_deleted, files = known.get(folder.name, ("", deleted, ""))
        is_settled = state in ("complete", "failed", "damaged") and was_deleted == deleted
        with contextlib.suppress(OSError):
            is_same = files == read_files(folder)
            if is_settled and is_same and not (folder / STREAM_FILE).exists():
                continue
        waiting.append((folder, deleted, state))
    yield 0, len(waiting)
    # Ids begin with the time: the newest runs, which users need most, are listed first.
    waiting.sort(key=lambda item: item[0].name, reverse=True)
    for done, (folder, deleted, state) in enumerate(waiting, 1):
        try:
            _recover_run(database, folder, deleted, state)
        except (FileNotFoundError, UnknownRunError):
            pass  # another process removed it at the same time
        except OSError as error:  # for example no permission
            _log.warning("Run %s cannot be listed: %s.", folder.name, error)
        yield done, len(waiting)
    for run_id in known.keys() - present:
        with contextlib.suppress(UnknownRunError):
            places = (runs / run_id, trash / run_id)
            database.revise(run_id, functools.partial(_miss, places))


def settle(database: Database, folder: Path, entry: RunEntry, failure: str) -> RunEntry:
    """Return the current entry of a recording: ended if no process writes it.

    Args:
        database: Stores the entry of an ended recording, if the disk has space.
        folder: Folder of the record.
        entry: An entry with the state "recording".
        failure: Reason for the end of the recording, if known.

    Returns:
        The entry.
    """
    if not folder.is_dir():
        return entry
    with claim(folder) as is_ended:
        if not is_ended:
            return entry
    if not failure and (folder / STREAM_FILE).exists():
        failure = CUT_OFF
    changes = describe(folder, failure)
    try:
        return database.change(entry.id, changes)
    except CatalogueError:  # for example a full disk: the list is correct nevertheless
        return dataclasses.replace(entry, **changes)


def _recover_run(database: Database, folder: Path, deleted: bool, state: str) -> None:
    """Finish and register one run, but not a folder whose recording never started."""
    if not state:
        # The process died before its first byte, and there is nothing to recover, or it is about to
        # record.
        if measure_bytes(folder) == 0:
            return
        database.add(build_entry(folder))
    entry = database.get(folder.name)
    changes = {"deleted": _choose_time(entry, deleted)} | _finish(folder, entry)

    def apply(now: RunEntry) -> dict[str, Any]:
        # Finishing a record takes long and does not hold the lock of the database: its result is
        # stored only if the entry is otherwise unchanged.
        is_as_seen = (now.state, now.deleted) == (entry.state, entry.deleted)
        if is_as_seen and folder.is_dir():
            return changes
        return {}  # another thread or process changed it in the meantime

    database.revise(folder.name, apply)


def _miss(places: tuple[Path, ...], _: RunEntry) -> dict[str, Any]:
    """Return the changes of an entry without a folder; none if it has moved."""
    # Checked again under the lock: the run may have moved to or from the trash.
    if any(place.exists() for place in places):
        return {}
    return {"state": "missing", "message": GONE}


def describe(folder: Path, failure: str = "") -> dict[str, Any]:
    """Build the entry of an ended record from all of its samples.

    Args:
        folder: Folder of the record.
        failure: Reason why the recording ended early; empty if it did not.

    Returns:
        Fields of `RunEntry`. A record that cannot be read completely is "damaged": the message has
        the reason, and what can still be read.
    """
    files: dict[str, Any] = {}
    try:
        files = {"files": read_files(folder)} if folder.is_dir() else {}
        record = open_record(folder)
        changes = {
            "state": "complete",
            "message": "",
            "first_tick": record.first_tick,
            "ticks": record.tick_count,
            "duration_s": record.duration_s,
            "bytes": measure_bytes(folder),
            **_describe(record),
        }
    except Exception as error:  # whatever damaged files cause must not stop the index of others
        reason = error if isinstance(error, RecordError | OSError) else f"{error!r:.200}."
        return files | {"state": "damaged", "message": f"{reason} {describe_readable(folder)}"}
    if failure:
        saved = f"The first {record.duration_s:.6g} s were saved and can be opened."
        changes |= {"state": "failed", "message": f"{failure} {saved}"}
    return files | changes


def read_files(folder: Path) -> str:
    """Compute a text that changes with the files, and with the version of svsa."""
    size = newest = 0
    for path in folder.iterdir():
        with contextlib.suppress(OSError):  # a draft that was renamed, a link in a circle
            state = path.stat()
            size, newest = size + state.st_size, max(newest, state.st_mtime_ns)
    return f"{__version__} {size} {newest}"


def _describe(record: Record) -> dict[str, Any]:
    """Read settings, metrics and measured window from the record."""
    window = find_measured_window(record)
    metrics = None if window is None else measure(record, window)
    if metrics is None:
        # Damage is detected only by reading, and the samples have not been read yet.
        for _ in record.iterate_batches():
            pass
    return {
        "window": window,
        "metrics": metrics,
        "settings": describe_settings(
            record.header, record.commands, record.first_tick, record.tick_count
        ),
        "fault": record.fault,
    }


def build_entry(folder: Path) -> RunEntry:
    """Build an entry from the record's header; if that is damaged, one with the name only."""
    created = datetime.fromtimestamp(folder.stat().st_mtime, UTC).isoformat(timespec="seconds")
    entry = RunEntry(id=folder.name, name=folder.name, created=created)
    with contextlib.suppress(SvsaError):
        header = read_header(folder)
        values = {field.name: getattr(header, field.name, None) for field in fields(entry)}
        known = {name: value for name, value in values.items() if value is not None}
        entry = dataclasses.replace(entry, **known)
    return entry


def _finish(folder: Path, entry: RunEntry) -> dict[str, Any]:
    """Finish a record and return the changes of its entry; none while it is recorded."""
    failure = ""
    if (folder / STREAM_FILE).exists():
        failure = CUT_OFF
        try:
            if recover(folder) is None:
                return {}
        except Exception as error:  # full disk, or damaged files: see `describe`
            failure = f"{CUT_OFF} {error}"
    changes = describe(folder, failure)
    if entry.state == "failed" and changes["state"] != "damaged":
        return changes | {"state": "failed", "message": entry.message}
    return changes


def _choose_time(entry: RunEntry, deleted: bool) -> str | None:
    now = datetime.now(UTC).isoformat(timespec="seconds")
    return (entry.deleted or now) if deleted else None


def _list_folders(runs: Path, trash: Path) -> Iterator[tuple[Path, bool]]:
    for place, deleted in ((trash, True), (runs, False)):
        for folder in sorted(place.iterdir()):
            if folder.is_dir() and is_run_id(folder.name):
                yield folder, deleted
