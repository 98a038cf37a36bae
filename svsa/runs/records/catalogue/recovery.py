"""Reconciliation of the catalogue with the folders of the runs after a crash."""

import contextlib
import dataclasses
import functools
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
GONE = "Its folder is gone."


def index_runs(database: Database, runs: Path, trash: Path) -> Iterator[tuple[int, int]]:
    """Finish unfinished records, register unknown folders, mark damaged and missing runs.

    A record whose files have not changed since it was described is not read again.

    Yields:
        How many records are done, and of how many; first (0, total), then after each record.
    """
    known = database.list_known()
    found: set[str] = set()
    waiting: list[tuple[Path, bool, str]] = []
    for folder, deleted in _list_folders(runs, trash):
        found.add(folder.name)
        state, was_deleted, files = known.get(folder.name, ("", deleted, ""))
        is_settled = state in ("complete", "failed", "damaged") and was_deleted == deleted
        if is_settled and not (folder / STREAM_FILE).exists() and files == read_files(folder):
            continue
        waiting.append((folder, deleted, state))
    yield 0, len(waiting)
    # The ids begin with the time: the newest runs, which are looked for most, are listed first.
    waiting.sort(key=lambda one: one[0].name, reverse=True)
    for done, (folder, deleted, state) in enumerate(waiting, 1):
        # Another process may take it away meanwhile.
        with contextlib.suppress(FileNotFoundError, UnknownRunError):
            _recover_run(database, folder, deleted, state)
        yield done, len(waiting)
    for run_id in known.keys() - found:
        with contextlib.suppress(UnknownRunError):
            places = (runs / run_id, trash / run_id)
            database.revise(run_id, functools.partial(_miss, places))


def settle(database: Database, folder: Path, entry: RunEntry, failure: str) -> RunEntry:
    """Return the entry of a recording in its present state: ended if no process writes it.

    Args:
        database: Takes the entry of an ended recording, if its disk has room.
        folder: The record's folder.
        entry: An entry that says "recording".
        failure: Why the recording ended, if that is known.
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
    except CatalogueError:  # as on a full disk: the list is right nevertheless
        return dataclasses.replace(entry, **changes)


def _recover_run(database: Database, folder: Path, deleted: bool, state: str) -> None:
    """Finish and register one run, but not a folder whose recording never started."""
    if not state:
        # The process died before its first byte: there is nothing to recover, or it records just
        # now.
        if not any(path.stat().st_size for path in folder.iterdir()):
            return
        database.add(build_entry(folder))
    entry = database.get(folder.name)
    changes = {"deleted": _choose_time(entry, deleted)} | _finish(folder, entry)

    def apply(now: RunEntry) -> dict[str, Any]:
        # Finishing a record takes long, and the lock of the database is not held meanwhile: what
        # was found is entered only if nothing else has changed.
        is_as_seen = (now.state, now.deleted) == (entry.state, entry.deleted)
        if is_as_seen and folder.is_dir():
            return changes
        return {}  # another thread or process changed it meanwhile, and knows better

    database.revise(folder.name, apply)


def _miss(places: tuple[Path, ...], _: RunEntry) -> dict[str, Any]:
    """Return the changes of an entry without a folder; none if it has moved."""
    # Looked for again under the lock: the run may have moved to the trash, or out of it.
    if any(place.exists() for place in places):
        return {}
    return {"state": "missing", "message": GONE}


def describe(folder: Path, failure: str = "") -> dict[str, Any]:
    """Build the entry of an ended record from every sample of it.

    Args:
        folder: The record's folder.
        failure: Why the recording ended early; empty if it did not.

    Returns:
        Fields of `RunEntry`. A record that cannot be read whole is "damaged": the message has the
        reason, and what can still be read.
    """
    files = {"files": read_files(folder)} if folder.is_dir() else {}
    try:
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
    except (RecordError, OSError) as error:
        return files | {"state": "damaged", "message": f"{error} {describe_readable(folder)}"}
    if failure:
        saved = f"What was written opens: {record.duration_s:.6g} s."
        changes |= {"state": "failed", "message": f"{failure} {saved}"}
    return files | changes


def read_files(folder: Path) -> str:
    """Compute a text that changes with the files, and with the version of svsa."""
    size = newest = 0
    for path in folder.iterdir():
        with contextlib.suppress(FileNotFoundError):  # a draft that took its place meanwhile
            state = path.stat()
            size, newest = size + state.st_size, max(newest, state.st_mtime_ns)
    return f"{__version__} {size} {newest}"


def _describe(record: Record) -> dict[str, Any]:
    """Read settings, metrics and measured window from the record."""
    window = find_measured_window(record)
    metrics = None if window is None else measure(record, window)
    if metrics is None:
        # Nothing has read the samples: damage is found by reading.
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
        except RecordError as error:  # a full disk, or a damaged stream: `describe` finds out
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
