"""The table of runs in SQLite: an index that can be rebuilt from the folders of the runs."""

import contextlib
import dataclasses
import functools
import logging
import os
import sqlite3
import threading
import weakref
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, Concatenate, ParamSpec, TypeVar

from svsa.inputs.file_lock import close_to_others
from svsa.inputs.set_aside import SQLITE_FILES, set_aside
from svsa.runs.records.catalogue.entry import (
    FACETS,
    CatalogueError,
    DamagedCatalogueError,
    Query,
    Reader,
    RunEntry,
    RunPage,
    UnknownRunError,
)
from svsa.runs.records.catalogue.table import get, has, prepare, put, put_branches

BUSY_TIMEOUT_S = 5.0
_NEVER_NULL = ("created", "name", "session", "duration_s", "bytes", "plant")
_OF_MACHINE = {
    sqlite3.SQLITE_PERM, sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED, sqlite3.SQLITE_NOMEM,
    sqlite3.SQLITE_READONLY, sqlite3.SQLITE_INTERRUPT, sqlite3.SQLITE_IOERR, sqlite3.SQLITE_FULL,
    sqlite3.SQLITE_CANTOPEN, sqlite3.SQLITE_PROTOCOL, sqlite3.SQLITE_AUTH,
}  # fmt: skip
"""The errors of SQLite that say nothing about the content of the database."""
_log = logging.getLogger("svsa")
_Args = ParamSpec("_Args")
_Result = TypeVar("_Result")


def _rebuilding(
    method: Callable[Concatenate["Database", _Args], _Result],
) -> Callable[Concatenate["Database", _Args], _Result]:
    """Call the method again with a new database if it finds the current one damaged."""

    @functools.wraps(method)
    def call(database: "Database", *args: _Args.args, **named: _Args.kwargs) -> _Result:
        file = database._identify()
        try:
            return method(database, *args, **named)
        except DamagedCatalogueError as error:
            database._rebuild(file, error)
            return method(database, *args, **named)

    return call


class Database:
    """The table of runs; one connection per call, safe for threads and processes.

    A damaged database is set aside, whenever the damage is found.

    Args:
        path: The file.
        fill: Adds all runs to a new database that replaces a damaged one in use.
    """

    def __init__(self, path: Path, fill: Callable[["Database"], object] = lambda _: None) -> None:
        self._path, self._fill = path, fill
        self._filling = threading.RLock()
        self._is_filling = False
        self.close: Callable[[], object] = lambda: None
        try:
            self._prepare()
        except DamagedCatalogueError as error:
            self._set_aside(error)
            self._prepare()
        self._keep_open()

    @_rebuilding
    def add(self, *entries: RunEntry) -> None:
        """Add runs; known ones stay unchanged."""
        with self._connect() as connection:
            connection.execute("BEGIN IMMEDIATE")
            for entry in entries:
                if not has(connection, entry.id):
                    put(connection, entry)
                    put_branches(connection, entry.id)

    def change(self, run_id: str, changes: dict[str, Any]) -> RunEntry:
        """Replace some fields of a run.

        Raises:
            UnknownRunError: If there is no such run.
        """
        return self.revise(run_id, lambda _: changes)

    @_rebuilding
    def revise(self, run_id: str, decide: Callable[[RunEntry], dict[str, Any]]) -> RunEntry:
        """Replace the fields that `decide` returns for the current entry.

        No other thread or process changes the table during this call, so that changes of the run's
        folder by `decide` are consistent with the table. An exception of `decide` leaves the run
        unchanged.

        Raises:
            UnknownRunError: If there is no such run.
        """
        with self._connect() as connection:
            # IMMEDIATE takes the write lock before the entry is read. A deferred transaction takes
            # it at its first write; by then another process may have changed the run.
            connection.execute("BEGIN IMMEDIATE")
            entry = get(connection, run_id)
            # `decide` may move folders: the lock makes this move and the change of the entry
            # atomic.
            changed = dataclasses.replace(entry, **decide(entry))
            put(connection, changed)
            # The list shows and searches the title of a branch's origin: a new title changes the
            # entries of the branches, too.
            if changed.title != entry.title:
                put_branches(connection, run_id)
        return changed

    @_rebuilding
    def get(self, run_id: str) -> RunEntry:
        """Return the run of this id.

        Raises:
            UnknownRunError: If there is no such run.
        """
        with self._connect() as connection:
            return get(connection, run_id)

    @_rebuilding
    def forget(self, run_id: str) -> None:
        """Remove a run from the table."""
        with self._connect() as connection:
            connection.execute("DELETE FROM runs WHERE id = ?", (run_id,))
            connection.execute("DELETE FROM entries WHERE id = ?", (run_id,))
            connection.execute("DELETE FROM facets WHERE run = ?", (run_id,))
            put_branches(connection, run_id)

    @_rebuilding
    def query(self, query: Query) -> RunPage:
        """Return a page of the runs that match the query."""
        where, values = _build_condition(query)
        window = (query.page_size, (query.page - 1) * query.page_size)
        order = build_order(query.sort)
        with self._connect() as connection:
            connection.execute("BEGIN")  # all reads see the same state
            if not query.words or query.page > 1:
                count = f"SELECT count(*) FROM runs WHERE {where}"  # noqa: S608
                (total,) = connection.execute(count, values).fetchone()
                columns = "id, 0"
            else:
                total, columns = 0, "id, count(*) OVER ()"
            select = f"SELECT {columns} FROM runs WHERE {where} ORDER BY {order} LIMIT ? OFFSET ?"  # noqa: S608
            rows = connection.execute(select, [*values, *window]).fetchall()
            try:
                entries = tuple(get(connection, run_id) for run_id, _ in rows)
            except UnknownRunError as error:
                raise DamagedCatalogueError(f"{error}") from None
        if rows and not total:
            total = rows[0][1]
        return RunPage(entries, total, query.page, query.page_size)

    @_rebuilding
    def list_facets(self, reader: Reader | None = None) -> dict[str, dict[str, int]]:
        """List the filters for runs outside the trash: facet, value, number of runs."""
        select, values = "SELECT facet, value, runs FROM counts WHERE runs > 0", []
        if reader is not None:
            readable, values = _build_readable(reader)
            select = (
                "SELECT facet, value, count(*) FROM facets WHERE trash = 0"  # noqa: S608
                f" AND run IN (SELECT id FROM runs WHERE {readable}) GROUP BY facet, value"
            )
        facets: dict[str, dict[str, int]] = {facet: {} for facet in FACETS}
        with self._connect() as connection:
            for facet, value, count in connection.execute(
                f"{select} ORDER BY facet, value", values
            ):
                if facet not in facets or not isinstance(value, str):
                    raise DamagedCatalogueError(f"invalid filter {facet!r:.40}: {value!r:.40}")
                facets[facet][value] = count
        return facets

    @_rebuilding
    def measure_bytes(self, owner: str) -> int:
        """Return the bytes of one owner's runs, including the trash."""
        select = "SELECT coalesce(sum(bytes), 0) FROM runs WHERE owner = ?"
        with self._connect() as connection:
            (taken,) = connection.execute(select, (owner,)).fetchone()
            return taken

    @_rebuilding
    def find(self, run_ids: Iterable[str]) -> dict[str, RunEntry]:
        """Return those of these runs that are known, by id."""
        with self._connect() as connection:
            known = [run_id for run_id in set(run_ids) if has(connection, run_id)]
            return {run_id: get(connection, run_id) for run_id in known}

    @_rebuilding
    def list_known(self) -> dict[str, tuple[str, bool, str]]:
        """List each run's state, whether it is in the trash, and `RunEntry.files`."""
        select = "SELECT id, state, trash, files FROM runs"
        with self._connect() as connection:
            rows = connection.execute(select)
            return {run_id: (state, bool(trash), files) for run_id, state, trash, files in rows}

    @contextlib.contextmanager
    def _connect(self) -> Iterator[sqlite3.Connection]:
        """Open a transaction.

        Raises:
            CatalogueError: If the database is unusable; `DamagedCatalogueError` if it is damaged.
        """
        try:
            self._check_files()
            connection = sqlite3.connect(self._path, timeout=BUSY_TIMEOUT_S)
            try:
                connection.execute("PRAGMA synchronous = NORMAL")
                with connection:
                    yield connection
            finally:
                connection.close()
        # An invalid text in the database, and in SQLite's message about it.
        except (sqlite3.Error, UnicodeDecodeError, DamagedCatalogueError) as error:
            kind = DamagedCatalogueError if _is_damage(error) else CatalogueError
            raise kind(f"The catalogue {self._path} cannot be used: {error}.") from None

    def _check_files(self) -> None:
        """Raise `DamagedCatalogueError` if a folder, pipe or link is in place of a file."""
        for ending in ("", *SQLITE_FILES):
            path = self._path.with_name(self._path.name + ending)
            if not path.is_file() and os.path.lexists(path):
                raise DamagedCatalogueError(f"{path.name} is not a file")

    def _prepare(self) -> None:
        # Other accounts must not read names and owners of runs; SQLite gives its other files the
        # same mode.
        close_to_others(self._path)
        with self._connect() as connection:
            prepare(connection)

    def _keep_open(self) -> None:
        """Keep one idle connection: closing the last one deletes the files of the write-ahead log.

        On a full disk they could not be created again, so that the list could not even be read.
        """
        with contextlib.suppress(sqlite3.Error):
            idle = sqlite3.connect(self._path, check_same_thread=False)
            self.close = weakref.finalize(self, idle.close)
            idle.execute("SELECT count(*) FROM runs").fetchone()

    def _identify(self) -> tuple[int, int] | None:
        """Return device and number of the database's file; None if it does not exist."""
        try:
            state = self._path.stat()
        except OSError:
            return None
        return state.st_dev, state.st_ino

    def _rebuild(self, file: tuple[int, int] | None, damage: DamagedCatalogueError) -> None:
        """Replace the damaged `file`, unless another thread or process already did."""
        with self._filling:
            if self._is_filling:
                raise damage  # of the new database
            if file is not None and self._identify() != file:
                return
            self._is_filling = True
            try:
                self.close()
                self._set_aside(damage)
                self._prepare()
                self._keep_open()
                self._fill(self)
            finally:
                self._is_filling = False

    def _set_aside(self, damage: DamagedCatalogueError) -> None:
        """Rename a damaged or foreign database; the folders of the runs have all its data."""
        try:
            aside = set_aside(self._path, SQLITE_FILES)
        except OSError as error:
            raise CatalogueError(f"The catalogue {self._path} is damaged: {error}.") from None
        _log.warning("%s It was renamed to %s; the runs are indexed again.", damage, aside.name)


def _is_damage(error: Exception) -> bool:
    """Whether an error shows that the content of the database is invalid."""
    code = getattr(error, "sqlite_errorcode", None)
    if code == sqlite3.SQLITE_IOERR_SHORT_READ:
        return True
    # Python reports an invalid text without a code.
    return code is None or code & 0xFF not in _OF_MACHINE


def _build_condition(query: Query) -> tuple[str, list[Any]]:
    conditions: list[str] = ["trash = ?"]
    values: list[Any] = [query.trash]
    for facet in query.facets:
        conditions.append("id IN (SELECT run FROM facets WHERE facet = ? AND value = ?)")
        values += facet
    for word in query.words:
        conditions.append("(instr(search, ?) OR id = ?)")
        values += (word, word)
    if query.reader is not None:
        readable, readers = _build_readable(query.reader)
        conditions.append(readable)
        values += readers
    return " AND ".join(conditions), values


def _build_readable(reader: Reader) -> tuple[str, list[Any]]:
    return "(owner IN ('', ?) OR session = ?)", [reader.person, reader.open_session]


def build_order(sort: str) -> str:
    """Build the ORDER BY of a `Query`; unknown values come last in both directions."""
    column, down = sort.removeprefix("-"), " DESC" if sort.startswith("-") else ""
    last = "" if column in _NEVER_NULL else " NULLS LAST"
    return f"{column}{down}{last}, id{down}"
