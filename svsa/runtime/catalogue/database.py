"""The table of runs in SQLite: an index that can be built anew from the folders of the runs."""

import contextlib
import dataclasses
import sqlite3
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from svsa.runtime.catalogue.entry import (
    CatalogueError,
    Query,
    RunEntry,
    RunPage,
    UnknownRunError,
    make_storable,
    read_entry,
    write_entry,
)

BUSY_TIMEOUT_S = 5.0
_VERSION = 1
_SCHEMA = """
CREATE TABLE IF NOT EXISTS runs (
    id TEXT PRIMARY KEY, created TEXT, name TEXT, session TEXT, duration_s REAL,
    bytes INTEGER, state TEXT, trash INTEGER, search TEXT
);
CREATE INDEX IF NOT EXISTS runs_by_time ON runs (trash, created, id);
CREATE TABLE IF NOT EXISTS entries (id TEXT PRIMARY KEY, entry TEXT);
CREATE TABLE IF NOT EXISTS tags (
    tag TEXT, run TEXT, trash INTEGER, PRIMARY KEY (tag, run)
) WITHOUT ROWID;
CREATE INDEX IF NOT EXISTS tags_by_run ON tags (run);
"""


class Database:
    """The table of runs; a connection a call, so that threads and processes may share it."""

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            self._prepare()
        except sqlite3.OperationalError as error:
            raise CatalogueError(f"The catalogue {path} cannot be used: {error}.") from None
        except sqlite3.DatabaseError:
            self._set_aside()
            self._prepare()

    def add(self, *entries: RunEntry) -> None:
        """Add runs; one that is known stays as it is."""
        with self._connect() as connection:
            connection.execute("BEGIN IMMEDIATE")
            for entry in entries:
                if not _has(connection, entry.id):
                    _put(connection, entry)

    def change(self, run_id: str, changes: dict[str, Any]) -> RunEntry:
        """Replace these fields of a run and no others; raises `UnknownRunError`."""
        return self.revise(run_id, lambda _: changes)

    def revise(self, run_id: str, decide: Callable[[RunEntry], dict[str, Any]]) -> RunEntry:
        """Replace the fields that `decide` makes of the run as it stands.

        No thread and no process changes the table meanwhile: what `decide` does to the run's
        folder and what the table says of it agree. Raises `UnknownRunError`, and what `decide`
        raises, with the run unchanged.
        """
        with self._connect() as connection:
            connection.execute("BEGIN IMMEDIATE")
            entry = _get(connection, run_id)
            changed = dataclasses.replace(entry, **decide(entry))
            _put(connection, changed)
        return changed

    def get(self, run_id: str) -> RunEntry:
        """The run of this id; raises `UnknownRunError`."""
        with self._connect() as connection:
            return _get(connection, run_id)

    def forget(self, run_id: str) -> None:
        """Take a run out of the table."""
        with self._connect() as connection:
            connection.execute("DELETE FROM runs WHERE id = ?", (run_id,))
            connection.execute("DELETE FROM entries WHERE id = ?", (run_id,))
            connection.execute("DELETE FROM tags WHERE run = ?", (run_id,))

    def query(self, query: Query) -> RunPage:
        """A page of the runs that the query is for."""
        conditions: list[str] = ["trash = ?"]
        values: list[Any] = [query.trash]
        if query.tag is not None:
            conditions.append("id IN (SELECT run FROM tags WHERE tag = ?)")
            values.append(make_storable(query.tag))
        for word in query.words:
            conditions.append("instr(search, ?)")
            values.append(word)
        where, down = " AND ".join(conditions), " DESC" if query.sort.startswith("-") else ""
        column = query.sort.removeprefix("-")
        nocase = " COLLATE NOCASE" if column in ("name", "session") else ""
        order = f"{column}{nocase}{down}, id{down}"
        window = (query.page_size, (query.page - 1) * query.page_size)
        with self._connect() as connection:
            count = f"SELECT count(*) FROM runs WHERE {where}"  # noqa: S608
            (total,) = connection.execute(count, values).fetchone()
            select = f"SELECT id FROM runs WHERE {where} ORDER BY {order} LIMIT ? OFFSET ?"  # noqa: S608
            found = connection.execute(select, [*values, *window]).fetchall()
            entries = tuple(_get(connection, run_id) for (run_id,) in found)
        return RunPage(entries, total, query.page, query.page_size)

    def list_tags(self) -> dict[str, int]:
        """Every tag of the runs that are not in the trash, and how many have it."""
        select = "SELECT tag, count(*) FROM tags WHERE trash = 0 GROUP BY tag ORDER BY tag"
        with self._connect() as connection:
            return dict(connection.execute(select).fetchall())

    def list_states(self) -> dict[str, tuple[str, bool]]:
        """For every run its state and whether it is in the trash."""
        with self._connect() as connection:
            rows = connection.execute("SELECT id, state, trash FROM runs")
            return {run_id: (state, bool(deleted)) for run_id, state, deleted in rows}

    @contextlib.contextmanager
    def _connect(self) -> Iterator[sqlite3.Connection]:
        """A transaction; raises `CatalogueError` where the database cannot be used."""
        try:
            connection = sqlite3.connect(self._path, timeout=BUSY_TIMEOUT_S)
            try:
                connection.execute("PRAGMA synchronous = NORMAL")
                with connection:
                    yield connection
            finally:
                connection.close()
        except sqlite3.Error as error:
            raise CatalogueError(f"The catalogue {self._path} cannot be used: {error}.") from None

    def _prepare(self) -> None:
        connection = sqlite3.connect(self._path, timeout=BUSY_TIMEOUT_S)
        try:
            connection.execute("PRAGMA journal_mode = WAL")
            (version,) = connection.execute("PRAGMA user_version").fetchone()
            if version not in (0, _VERSION):
                known = f"this version of svsa reads format {_VERSION}"
                raise CatalogueError(f"The catalogue {self._path} is of format {version}; {known}.")
            connection.executescript(_SCHEMA)
            connection.execute(f"PRAGMA user_version = {_VERSION}")
            (verdict,) = connection.execute("PRAGMA quick_check(1)").fetchone()
            if verdict != "ok":
                raise sqlite3.DatabaseError(verdict)
        finally:
            connection.close()

    def _set_aside(self) -> None:
        """Keep a database that is none under another name; the folders hold all it knew."""
        number = 1
        while (aside := self._path.with_name(f"{self._path.name}.damaged-{number}")).exists():
            number += 1
        try:
            self._path.replace(aside)
            for ending in ("-wal", "-shm"):
                self._path.with_name(self._path.name + ending).unlink(missing_ok=True)
        except OSError as error:
            raise CatalogueError(f"The catalogue {self._path} is damaged: {error}.") from None


def _put(connection: sqlite3.Connection, entry: RunEntry) -> None:
    trash = entry.deleted is not None
    texts = (entry.id, entry.name, entry.session, *entry.tags, entry.notes)
    search = "\n".join(texts).casefold()
    row = (entry.id, entry.created, entry.name, entry.session, entry.duration_s, entry.bytes)
    connection.execute(
        "REPLACE INTO runs VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)", (*row, entry.state, trash, search)
    )
    connection.execute("REPLACE INTO entries VALUES (?, ?)", (entry.id, write_entry(entry)))
    connection.execute("DELETE FROM tags WHERE run = ?", (entry.id,))
    rows = [(tag, entry.id, trash) for tag in entry.tags]
    connection.executemany("INSERT INTO tags VALUES (?, ?, ?)", rows)


def _has(connection: sqlite3.Connection, run_id: str) -> bool:
    found = connection.execute("SELECT 1 FROM entries WHERE id = ?", (run_id,))
    return found.fetchone() is not None


def _get(connection: sqlite3.Connection, run_id: str) -> RunEntry:
    select = "SELECT entry FROM entries WHERE id = ?"
    found = connection.execute(select, (run_id,)).fetchone()
    if found is None:
        raise UnknownRunError(f"There is no run {run_id!r:.80}.")
    return read_entry(found[0])
