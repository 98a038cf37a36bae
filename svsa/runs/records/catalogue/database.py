"""The table of runs in SQLite: an index that can be rebuilt from the folders of the runs."""

import contextlib
import dataclasses
import sqlite3
import weakref
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

from svsa.inputs.file_lock import close_to_others
from svsa.runs.records.catalogue.entry import (
    FACETS,
    CatalogueError,
    Query,
    Reader,
    RunEntry,
    RunPage,
)
from svsa.runs.records.catalogue.table import get, has, prepare, put, put_branches

BUSY_TIMEOUT_S = 5.0
_NEVER_NULL = ("created", "name", "session", "duration_s", "bytes", "plant")


class Database:
    """The table of runs; one connection per call, safe for threads and processes."""

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            self._prepare()
        except (sqlite3.OperationalError, CatalogueError) as error:
            raise CatalogueError(f"The catalogue {path} cannot be used: {error}.") from None
        except sqlite3.DatabaseError:
            self._set_aside()
            self._prepare()
        self.close: Callable[[], object] = lambda: None
        self._keep_open()

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

    def get(self, run_id: str) -> RunEntry:
        """Return the run of this id.

        Raises:
            UnknownRunError: If there is no such run.
        """
        with self._connect() as connection:
            return get(connection, run_id)

    def forget(self, run_id: str) -> None:
        """Remove a run from the table."""
        with self._connect() as connection:
            connection.execute("DELETE FROM runs WHERE id = ?", (run_id,))
            connection.execute("DELETE FROM entries WHERE id = ?", (run_id,))
            connection.execute("DELETE FROM facets WHERE run = ?", (run_id,))
            put_branches(connection, run_id)

    def query(self, query: Query) -> RunPage:
        """Return a page of the runs that match the query."""
        where, values = _build_condition(query)
        window = (query.page_size, (query.page - 1) * query.page_size)
        order = build_order(query.sort)
        with self._connect() as connection:
            if not query.words or query.page > 1:
                count = f"SELECT count(*) FROM runs WHERE {where}"  # noqa: S608
                (total,) = connection.execute(count, values).fetchone()
                columns = "id, 0"
            else:
                total, columns = 0, "id, count(*) OVER ()"
            select = f"SELECT {columns} FROM runs WHERE {where} ORDER BY {order} LIMIT ? OFFSET ?"  # noqa: S608
            found = connection.execute(select, [*values, *window]).fetchall()
            entries = tuple(get(connection, run_id) for run_id, _ in found)
        if found and not total:
            total = found[0][1]
        return RunPage(entries, total, query.page, query.page_size)

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
                facets[facet][value] = count
        return facets

    def measure_bytes(self, owner: str) -> int:
        """Return the bytes of one owner's runs, including the trash."""
        select = "SELECT coalesce(sum(bytes), 0) FROM runs WHERE owner = ?"
        with self._connect() as connection:
            (taken,) = connection.execute(select, (owner,)).fetchone()
            return taken

    def find(self, run_ids: Iterable[str]) -> dict[str, RunEntry]:
        """Return those of these runs that are known, by id."""
        with self._connect() as connection:
            known = [run_id for run_id in set(run_ids) if has(connection, run_id)]
            return {run_id: get(connection, run_id) for run_id in known}

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
            CatalogueError: If the database is unusable.
        """
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
        # Other accounts must not read names and owners of runs; SQLite gives its other files the
        # same mode.
        close_to_others(self._path)
        connection = sqlite3.connect(self._path, timeout=BUSY_TIMEOUT_S)
        try:
            prepare(connection)
            (verdict,) = connection.execute("PRAGMA quick_check(1)").fetchone()
            if verdict != "ok":
                raise sqlite3.DatabaseError(verdict)
        finally:
            connection.close()

    def _keep_open(self) -> None:
        """Keep one idle connection: closing the last one deletes the files of the write-ahead log.

        On a full disk they could not be created again, so that the list could not even be read.
        """
        with contextlib.suppress(sqlite3.Error):
            idle = sqlite3.connect(self._path, check_same_thread=False)
            self.close = weakref.finalize(self, idle.close)
            idle.execute("SELECT count(*) FROM runs").fetchone()

    def _set_aside(self) -> None:
        """Rename an invalid database; the folders have all its data."""
        number = 1
        while (aside := self._path.with_name(f"{self._path.name}.damaged-{number}")).exists():
            number += 1
        try:
            self._path.replace(aside)
            for ending in ("-wal", "-shm"):
                self._path.with_name(self._path.name + ending).unlink(missing_ok=True)
        except OSError as error:
            raise CatalogueError(f"The catalogue {self._path} is damaged: {error}.") from None


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
