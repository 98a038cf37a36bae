"""The tables of the catalogue: columns to sort and filter by, and the entries.

Format 7. Format 1 has no settings, 2 has metrics of whole records, 3 has no owners, 4 has a former
word for the steady-state error, 5 has fewer metrics, and 6 does not contain the described files. An
older catalogue is rebuilt from its entries; `index_runs` then reads the rest from the folders.
"""

import re
import sqlite3
from contextlib import closing
from functools import cache
from typing import Any

from svsa.actuators.faults import label_fault
from svsa.runs.records.catalogue.entry import (
    SORTS,
    DamagedCatalogueError,
    RunEntry,
    UnknownRunError,
    fold,
    read_entry,
    write_entry,
)

VERSION = 8
_TABLES = {"runs", "entries", "facets", "counts", "tags"}
"""The tables of this format and of older ones."""
_COLUMNS = {
    "id": "TEXT PRIMARY KEY",
    "created": "TEXT NOT NULL",
    "name": "TEXT NOT NULL",
    "session": "TEXT NOT NULL",
    "duration_s": "REAL NOT NULL",
    "bytes": "INTEGER NOT NULL",
    "state": "TEXT NOT NULL",
    "trash": "INTEGER NOT NULL",
    "files": "TEXT NOT NULL",
    "figure": "TEXT",
    "laws": "TEXT",
    "stiffness_nm_per_rad": "REAL",
    "load": "TEXT",
    "effects": "TEXT",
    "plant": "TEXT NOT NULL",
    "peak_position_error_rad": "REAL",
    "steady_state_position_error_rad": "REAL",
    "rms_position_error_rad": "REAL",
    "branch_run": "TEXT",
    "owner": "TEXT NOT NULL",
    "search": "TEXT NOT NULL",
}
_SCHEMA = (
    f"CREATE TABLE runs ({', '.join(f'{name} {kind}' for name, kind in _COLUMNS.items())})",
    *(f"CREATE INDEX runs_by_{column} ON runs (trash, {column}, id)" for column in SORTS),
    "CREATE INDEX runs_by_origin ON runs (branch_run)",
    "CREATE INDEX runs_by_owner ON runs (owner)",
    "CREATE TABLE entries (id TEXT PRIMARY KEY, entry TEXT)",
    "CREATE TABLE facets (facet TEXT, value TEXT, run TEXT, trash INTEGER,"
    " PRIMARY KEY (facet, value, run)) WITHOUT ROWID",
    "CREATE INDEX facets_by_run ON facets (run)",
    "CREATE TABLE counts (facet TEXT, value TEXT, runs INTEGER, PRIMARY KEY (facet, value))"
    " WITHOUT ROWID",
    "CREATE TRIGGER count_in AFTER INSERT ON facets WHEN new.trash = 0 BEGIN"
    " INSERT INTO counts VALUES (new.facet, new.value, 1)"
    " ON CONFLICT DO UPDATE SET runs = runs + 1; END",
    "CREATE TRIGGER count_out AFTER DELETE ON facets WHEN old.trash = 0 BEGIN"
    " UPDATE counts SET runs = runs - 1 WHERE facet = old.facet AND value = old.value; END",
)
_NUMBER = re.compile(r"\d+", re.ASCII)
_DIGITS = 20


def prepare(connection: sqlite3.Connection) -> None:
    """Create the tables, or rebuild older ones.

    Raises:
        DamagedCatalogueError: If it is not a catalogue of this format or of an older one.
    """
    if not _is_current(connection):
        with connection:
            connection.execute("BEGIN IMMEDIATE")
            # Tested again under the lock: another process may have created the tables.
            if not _is_current(connection):
                _build(connection)
    connection.execute("PRAGMA journal_mode = WAL")
    # The complete check: a damaged index hides runs or lists them twice.
    (verdict,) = connection.execute("PRAGMA integrity_check(1)").fetchone()
    if verdict != "ok":
        raise DamagedCatalogueError(" ".join(str(verdict).split()))  # in one line


def _is_current(connection: sqlite3.Connection) -> bool:
    (version,) = connection.execute("PRAGMA user_version").fetchone()
    schema = _read_schema(connection)
    if version == VERSION and schema == _build_schema():
        return True
    tables = {table for _, table in schema}
    if (version, tables) == (0, set()):
        return False
    if 0 < version < VERSION and "entries" in tables and tables <= _TABLES:
        return False
    raise DamagedCatalogueError(f"it is not a catalogue of format {VERSION} or older")


def _read_schema(connection: sqlite3.Connection) -> dict[tuple[str, str], str]:
    """Read the statements that created each object of the database, by object and table."""
    rows = connection.execute("SELECT name, tbl_name, sql FROM sqlite_master WHERE sql NOT NULL")
    return {(name, table): sql for name, table, sql in rows}


@cache
def _build_schema() -> dict[tuple[str, str], str]:
    with closing(sqlite3.connect(":memory:")) as connection:
        _build(connection)
        return _read_schema(connection)


def _build(connection: sqlite3.Connection) -> None:
    entries: list[tuple[str]] = []
    if ("entries", "entries") in _read_schema(connection):
        entries = connection.execute("SELECT entry FROM entries").fetchall()
    for table in _TABLES:
        connection.execute(f"DROP TABLE IF EXISTS {table}")
    for statement in _SCHEMA:
        connection.execute(statement)
    for (text,) in entries:
        put(connection, read_entry(text))
    connection.execute(f"PRAGMA user_version = {VERSION}")


def put(connection: sqlite3.Connection, entry: RunEntry) -> None:
    """Write a run into every table, replacing a known one."""
    trash = int(entry.deleted is not None)
    row = _build_row(entry, trash) | {"search": _build_search(connection, entry)}
    columns, places = ", ".join(row), ", ".join("?" * len(row))
    replace = f"REPLACE INTO runs ({columns}) VALUES ({places})"  # noqa: S608
    connection.execute(replace, list(row.values()))
    connection.execute("REPLACE INTO entries VALUES (?, ?)", (entry.id, write_entry(entry)))
    connection.execute("DELETE FROM facets WHERE run = ?", (entry.id,))
    rows = [(facet, value, entry.id, trash) for facet, value in entry.facets]
    connection.executemany("INSERT INTO facets VALUES (?, ?, ?, ?)", rows)


def put_branches(connection: sqlite3.Connection, run_id: str) -> None:
    """Rewrite the runs that branched from this one, since they show its name."""
    select = "SELECT id FROM runs WHERE branch_run = ?"
    for (branch,) in connection.execute(select, (run_id,)).fetchall():
        put(connection, get(connection, branch))


def get(connection: sqlite3.Connection, run_id: str) -> RunEntry:
    """Return the run of this id.

    Raises:
        UnknownRunError: If there is no such run.
    """
    text = _find(connection, run_id)
    if text is None:
        raise UnknownRunError(f"There is no run {run_id!r:.80}.")
    return read_entry(text)


def has(connection: sqlite3.Connection, run_id: str) -> bool:
    """Whether a run of this id exists."""
    return _find(connection, run_id) is not None


def _find(connection: sqlite3.Connection, run_id: str) -> str | None:
    row = connection.execute("SELECT entry FROM entries WHERE id = ?", (run_id,)).fetchone()
    return None if row is None else row[0]


def _build_row(entry: RunEntry, trash: int) -> dict[str, Any]:
    settings, metrics = entry.settings, entry.metrics
    first = metrics[0] if metrics else None
    return {
        "id": entry.id,
        "created": entry.created,
        "name": _order(entry.title) or "",
        "session": _order(entry.session) or "",
        "duration_s": entry.duration_s,
        "bytes": entry.bytes,
        "state": entry.state,
        "trash": trash,
        "files": entry.files,
        "figure": _order(settings.figure) if settings else None,
        "laws": _order(settings.laws) if settings else None,
        "stiffness_nm_per_rad": settings.stiffness_nm_per_rad if settings else None,
        "load": _order(settings.load) if settings else None,
        "effects": _order(settings.effects) if settings else None,
        "plant": entry.plant,
        "peak_position_error_rad": first.peak_position_error_rad if first else None,
        "steady_state_position_error_rad": first.steady_state_position_error_rad if first else None,
        "rms_position_error_rad": first.rms_position_error_rad if first else None,
        "branch_run": entry.branch_of.run_id if entry.branch_of else None,
        "owner": entry.owner,
    }


def _order(text: str) -> str | None:
    """Build a sort key that orders "Group 9" before "Group 10"; None for an empty text."""
    return _NUMBER.sub(lambda digits: digits[0].zfill(_DIGITS), fold(text)) or None


def _build_search(connection: sqlite3.Connection, entry: RunEntry) -> str:
    """Build the searchable text of a row, one line per item, so that no word spans two."""
    texts = [entry.title, *entry.tags, entry.notes, entry.message]
    texts += [label_fault(entry.fault.code)] if entry.fault else []
    if settings := entry.settings:
        stiffness = f"σ {settings.stiffness}" if settings.stiffness else ""
        texts += [entry.figure or settings.motion, settings.laws, stiffness, settings.load]
        texts += [settings.effects, f"own {settings.own}" if settings.own else ""]
    if entry.branch_of is not None:
        origin = _find(connection, entry.branch_of.run_id)
        texts.append(entry.branch_of.run_id if origin is None else read_entry(origin).title)
    return fold("\n".join(texts))
