"""Bring the catalogue and the folders of the runs back together after a crash."""

import contextlib
import dataclasses
import functools
import time
from collections.abc import Iterator
from dataclasses import dataclass, fields
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from svsa.errors import SvsaError
from svsa.runs.metrics import MEASURED, Metrics, RunningMetrics
from svsa.runs.records.catalogue.database import Database
from svsa.runs.records.catalogue.entry import RunEntry, UnknownRunError
from svsa.runs.records.header import STREAM_FILE, RecordError, is_run_id, read_header
from svsa.runs.records.measured_window import MeasuredWindow, find_measured_window, summarize
from svsa.runs.records.parquet import measure_bytes
from svsa.runs.records.reader import Record, open_record, recover
from svsa.runs.records.settings import describe_settings

CUT_OFF = "The recording was cut off; what had been written is here."
GONE = "Its folder is gone."


@dataclass(frozen=True)
class Recovery:
    """What a recovery did, as ids; problems: ids with what is wrong with their records."""

    finished: tuple[str, ...]
    registered: tuple[str, ...]
    problems: tuple[tuple[str, str], ...]


def recover_runs(database: Database, runs: Path, trash: Path) -> Recovery:
    """Finish every unfinished record, register every unknown folder, mark what is gone."""
    finished: list[str] = []
    registered: list[str] = []
    problems: list[tuple[str, str]] = []
    known = database.list_states()
    found: set[str] = set()
    for folder, deleted in _list_folders(runs, trash):
        found.add(folder.name)
        state, was_deleted = known.get(folder.name, ("", deleted))
        unfinished = (folder / STREAM_FILE).exists()
        if state not in ("", "recording", "missing") and was_deleted == deleted and not unfinished:
            continue
        try:
            entry = _recover_run(database, folder, deleted, state)
        except (FileNotFoundError, UnknownRunError):
            continue  # another process took it away meanwhile
        if entry is None:
            continue
        if not state:
            registered.append(folder.name)
        elif unfinished and entry.state == "complete":
            finished.append(folder.name)
        if entry.state == "damaged":
            problems.append((folder.name, entry.message))
    for run_id in known.keys() - found:
        with contextlib.suppress(UnknownRunError):
            places = (runs / run_id, trash / run_id)
            if database.revise(run_id, functools.partial(_miss, places)).state == "missing":
                problems.append((run_id, GONE))
    return Recovery(tuple(finished), tuple(registered), tuple(problems))


def describe_older(database: Database, places: tuple[Path, ...]) -> None:
    """Give the runs what older versions did not enter: settings, metrics of a named window, fault.

    What cannot be read stays without. It sleeps half of the time, so that thousands of runs
    do not delay a loop on the same machine.
    """
    for run_id in database.list_undescribed():
        begin = time.perf_counter()
        for folder in (place / run_id for place in places):
            with contextlib.suppress(RecordError, OSError, UnknownRunError):
                database.change(run_id, _describe(open_record(folder)))
        time.sleep(time.perf_counter() - begin)


def _recover_run(database: Database, folder: Path, deleted: bool, state: str) -> RunEntry | None:
    """Finish and enter one run; None for a folder that a recording had only begun to make."""
    if not state:
        # The process died before its first byte: there is nothing to recover, or it records just
        # now.
        if not any(path.stat().st_size for path in folder.iterdir()):
            return None
        database.add(build_entry(folder))
    entry = database.get(folder.name)
    changes: dict[str, Any] = {"deleted": _choose_time(entry, deleted)}
    unfinished = (folder / STREAM_FILE).exists()
    if unfinished or state in ("", "recording", "missing"):
        changes |= _finish(folder, entry, unfinished)

    def apply(now: RunEntry) -> dict[str, Any]:
        # Finishing a record takes long, and the lock of the database is not held meanwhile: what
        # was found is entered only if nothing else has changed.
        is_as_seen = (now.state, now.deleted) == (entry.state, entry.deleted)
        if is_as_seen and folder.is_dir():
            return changes
        return {}  # another thread or process changed it meanwhile, and knows better

    return database.revise(folder.name, apply)


def _miss(places: tuple[Path, ...], _: RunEntry) -> dict[str, Any]:
    """What changes of an entry whose folder was not found; nothing where it has moved."""
    # Looked for again under the lock: the run may have moved to the trash, or out of it.
    if any(place.exists() for place in places):
        return {}
    return {"state": "missing", "message": GONE}


def describe(folder: Path) -> dict[str, Any]:
    """What an entry says of a finished record; "damaged" where it cannot be read."""
    try:
        record = open_record(folder)
        return {
            "state": "complete",
            "message": "",
            "first_tick": record.first_tick,
            "ticks": record.tick_count,
            "duration_s": record.duration_s,
            "bytes": measure_bytes(folder),
            **_describe(record),
        }
    except (RecordError, OSError) as error:
        return {"state": "damaged", "message": str(error)}


def _describe(record: Record) -> dict[str, Any]:
    """What is read from the record itself: how it was set, how well it did, and in which window."""
    window = find_measured_window(record)
    return {
        "window": window,
        "metrics": None if window is None else measure(record, window),
        "settings": describe_settings(
            record.header, record.commands, record.first_tick, record.tick_count
        ),
        "fault": record.fault,
    }


def measure(record: Record, window: MeasuredWindow) -> tuple[Metrics, ...] | None:
    """The metrics of every lane in the window, a stretch at a time.

    None without the channels for it, or with samples that are no numbers.
    """
    names = record.header.channel_names
    if not set(MEASURED) <= set(names):
        return None
    places = [names.index(name) for name in MEASURED]
    lanes = [RunningMetrics(record.header.period_s) for _ in record.header.lanes]
    for tick, samples in record.iterate():
        rows = samples[max(0, window.first_tick - tick) : max(0, window.end_tick - tick)]
        for lane, running in enumerate(lanes):
            running.update_measured(rows[:, lane, places])
    return summarize(lanes, window)


def build_entry(folder: Path) -> RunEntry:
    """An entry from the record's header; where that is damaged, one that at least names it."""
    created = datetime.fromtimestamp(folder.stat().st_mtime, UTC).isoformat(timespec="seconds")
    entry = RunEntry(id=folder.name, name=folder.name, created=created)
    with contextlib.suppress(SvsaError):
        header = read_header(folder)
        values = {field.name: getattr(header, field.name, None) for field in fields(entry)}
        known = {name: value for name, value in values.items() if value is not None}
        entry = dataclasses.replace(entry, **known)
    return entry


def _finish(folder: Path, entry: RunEntry, unfinished: bool) -> dict[str, Any]:
    """What changes of the entry by finishing its record; nothing while a process records it."""
    try:
        if unfinished and recover(folder) is None:
            return {}
    except RecordError as error:
        return {"state": "damaged", "message": str(error)}
    changes = describe(folder)
    if changes["state"] == "complete" and unfinished:
        if entry.state == "failed":
            return changes | {"state": "failed", "message": entry.message}
        return changes | {"message": CUT_OFF}
    return changes


def _choose_time(entry: RunEntry, deleted: bool) -> str | None:
    now = datetime.now(UTC).isoformat(timespec="seconds")
    return (entry.deleted or now) if deleted else None


def _list_folders(runs: Path, trash: Path) -> Iterator[tuple[Path, bool]]:
    for place, deleted in ((trash, True), (runs, False)):
        for folder in sorted(place.iterdir()):
            if folder.is_dir() and is_run_id(folder.name):
                yield folder, deleted
