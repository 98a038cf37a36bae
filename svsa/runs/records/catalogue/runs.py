"""Runs on this machine: find, name, tag, delete and restore.

SVSA_DATA contains runs/<id> (see `recorder`), trash/<id>, and catalogue.sqlite. The latter is only
an index: `recover` rebuilds it from the folders.
"""

import dataclasses
import shutil
from collections.abc import Iterable, Iterator
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Any

from svsa.errors import StateError
from svsa.inputs.data_folder import find_data_folder
from svsa.runs.records.catalogue.database import Database
from svsa.runs.records.catalogue.entry import (
    CatalogueError,
    ChangedRunError,
    Query,
    Reader,
    RunEntry,
    RunPage,
    UnknownRunError,
)
from svsa.runs.records.catalogue.recovery import (
    build_entry,
    describe,
    index_runs,
    read_files,
    settle,
)
from svsa.runs.records.header import (
    RecordError,
    RecordHeader,
    check_texts,
    is_run_id,
    read_header,
    write_header,
)
from svsa.runs.records.parquet import measure_bytes
from svsa.runs.records.reader import Record, open_record
from svsa.runs.records.recorder import Recorder, RecordStatus


class Catalogue:
    """The runs in a folder; safe to use from many threads and processes.

    Methods with the id of a run raise `UnknownRunError` if it does not exist.

    Args:
        folder: Folder of the runs; by default `find_data_folder`.

    Raises:
        CatalogueError: If the folder cannot be used.
    """

    def __init__(self, folder: Path | str | None = None) -> None:
        self.folder = find_data_folder() if folder is None else Path(folder)
        self._runs, self._trash = self.folder / "runs", self.folder / "trash"
        try:
            self._runs.mkdir(parents=True, exist_ok=True)
            self._trash.mkdir(exist_ok=True)
        except OSError as error:
            raise CatalogueError(f"Runs cannot be kept in {self.folder}: {error}.") from None
        self._database = Database(
            self.folder / "catalogue.sqlite", partial(_fill, self._runs, self._trash)
        )
        self._recorders: dict[str, Recorder] = {}
        self._is_indexing = False

    def close(self) -> None:
        """Close the database file; the catalogue stays usable."""
        self._database.close()

    def record(self, header: RecordHeader) -> Recorder:
        """Start to record a run and add it to the list.

        Args:
            header: Id, settings and origin of the run.

        Returns:
            The recorder, which receives samples and commands.

        Raises:
            RecordError: If the record cannot be written.
        """
        # Create the folder before the entry: after a crash in between, `recover` adds the entry.
        recorder = Recorder(self._runs / header.run_id, header)
        try:
            self.register(header)
        except CatalogueError:
            recorder.close()
            raise
        self._recorders[header.run_id] = recorder
        return recorder

    def register(self, header: RecordHeader) -> RunEntry:
        """Add an existing run's folder to the list.

        Args:
            header: Header of the run.

        Returns:
            The new entry.
        """
        self._database.add(build_entry(self._runs / header.run_id))
        return self._database.get(header.run_id)

    def finish(self, run_id: str, status: RecordStatus | None = None) -> RunEntry:
        """Measure a run whose recording has ended, and complete its entry.

        Reads the whole record: not to be called in the thread of the loop.

        Args:
            run_id: Id of the run.
            status: The recorder's last status.

        Returns:
            The entry. A record whose file is not finished stays "recording" until it is, or until
            the next `recover`.
        """
        if status is not None and status.state == "recording":
            return self.get(run_id)
        failure = status.message if status is not None and status.state == "failed" else ""
        entry = self._database.change(run_id, describe(self.find_folder(run_id), failure))
        self._recorders.pop(run_id, None)
        return entry

    def get(self, run_id: str) -> RunEntry:
        """Return the entry of a run, in the trash or not.

        Args:
            run_id: Id of the run.

        Returns:
            The entry.

        Raises:
            UnknownRunError: If there is no such run.
        """
        if not is_run_id(run_id):
            raise UnknownRunError(f"There is no run {run_id!r:.80}.")
        return self._settle(self._database.get(run_id))

    def open(self, run_id: str) -> Record:
        """Open the record of a run.

        Args:
            run_id: Id of the run.

        Returns:
            The record, read on demand.

        Raises:
            RecordError: If the record is unreadable.
            UnknownRunError: If there is no such run.
        """
        return open_record(self.find_folder(run_id))

    def update(
        self,
        run_id: str,
        *,
        name: str | None = None,
        tags: tuple[str, ...] | None = None,
        notes: str | None = None,
        expected: str | None = None,
    ) -> RunEntry:
        """Change name, tags or notes of a run.

        Args:
            run_id: Id of the run.
            name: New name; None keeps the current one.
            tags: New tags; None keeps the current ones.
            notes: New notes; None keeps the current ones.
            expected: Revision of the entry that the change is based on.

        Returns:
            The changed entry.

        Raises:
            ParameterError: If a value is invalid.
            ChangedRunError: If the revision is no longer `expected`.
        """
        self.get(run_id)
        fields = {"name": name, "tags": tags, "notes": notes}
        changes: dict[str, Any] = {k: value for k, value in fields.items() if value is not None}
        if tags is not None:
            changes["tags"] = tuple(tags)

        def write(entry: RunEntry) -> dict[str, Any]:
            if expected is not None and expected != entry.revision:
                raise ChangedRunError(
                    f"Run {run_id} was changed meanwhile: its name, tags or notes are others now."
                )
            changed = dataclasses.replace(entry, **changes)
            check_texts(changed.name, changed.tags, changed.notes)
            if entry.state in ("damaged", "missing"):
                return changes
            folder = self._locate(entry)
            try:
                write_header(folder, read_header(folder).changed(**changes))
            except OSError as error:
                raise RecordError(f"Run {run_id} cannot be changed: {error}.") from None
            return changes | {"bytes": measure_bytes(folder), "files": read_files(folder)}

        return self._database.revise(run_id, write)

    def query(self, query: Query) -> RunPage:
        """Return one page of the list of runs.

        Args:
            query: Search, filters, order and page.

        Returns:
            The page.
        """
        page = self._database.query(query)
        return dataclasses.replace(page, runs=tuple(map(self._settle, page.runs)))

    def list_facets(self, reader: Reader | None = None) -> dict[str, dict[str, int]]:
        """List the values that the list can be filtered by.

        Args:
            reader: Reader whose runs are counted; None for all runs.

        Returns:
            Number of runs by value, by facet (see `Query`).
        """
        return self._database.list_facets(reader)

    def measure_bytes(self, owner: str) -> int:
        """Return the disk space of one owner's runs, including the trash.

        Args:
            owner: Id of the owner.

        Returns:
            Size, bytes.
        """
        return self._database.measure_bytes(owner)

    def find(self, run_ids: Iterable[str]) -> dict[str, RunEntry]:
        """Return those of some runs that exist, in the trash or not.

        Args:
            run_ids: Ids of runs.

        Returns:
            The entries by id.
        """
        return self._database.find(run_ids)

    def delete(self, run_id: str) -> RunEntry:
        """Move a run to the trash.

        Args:
            run_id: Id of the run.

        Returns:
            The changed entry.

        Raises:
            StateError: If the run is being recorded.
            UnknownRunError: If there is no such run.
        """
        self.get(run_id)

        def move_to_trash(entry: RunEntry) -> dict[str, Any]:
            if entry.state == "recording":
                raise StateError(f"Run {run_id} is being recorded: stop the recording first.")
            if entry.deleted is not None:
                return {}
            _move(self._runs / run_id, self._trash / run_id)
            return {"deleted": _format_time()}

        return self._database.revise(run_id, move_to_trash)

    def restore(self, run_id: str) -> RunEntry:
        """Restore a run from the trash.

        Args:
            run_id: Id of the run.

        Returns:
            The changed entry.
        """
        self.get(run_id)

        def move_from_trash(entry: RunEntry) -> dict[str, Any]:
            if entry.deleted is not None:
                _move(self._trash / run_id, self._runs / run_id)
            return {"deleted": None}

        return self._database.revise(run_id, move_from_trash)

    def purge(self, run_id: str) -> None:
        """Delete a run in the trash permanently.

        Args:
            run_id: Id of the run.

        Raises:
            StateError: If the run is not in the trash.
            RecordError: If its folder cannot be deleted.
        """
        if self.get(run_id).deleted is None:
            raise StateError(f"Run {run_id} is not in the trash: delete it first.")
        try:
            # Remove the folder before the entry: `recover` would list a remaining folder again.
            shutil.rmtree(self._trash / run_id)
        except FileNotFoundError:
            pass
        except OSError as error:
            raise RecordError(f"Run {run_id} cannot be deleted: {error}.") from None
        self._database.forget(run_id)

    def check(self, run_id: str) -> None:
        """Read a run completely, and mark it as damaged if it is.

        Args:
            run_id: Id of the run.
        """
        entry = self.get(run_id)
        if entry.state in ("complete", "failed"):
            changes = describe(self._locate(entry))
            if changes["state"] == "damaged":
                self._database.change(run_id, changes)

    def index(self) -> Iterator[tuple[int, int]]:
        """Finish interrupted records, and add missing entries; to be called at every start.

        The catalogue may be used at the same time.

        Yields:
            Numbers of finished and of all runs.
        """
        self._is_indexing = True
        try:
            yield from index_runs(self._database, self._runs, self._trash)
        finally:
            self._is_indexing = False

    def recover(self) -> None:
        """Run `index` completely."""
        for _ in self.index():
            pass

    def find_folder(self, run_id: str) -> Path:
        """Return the folder of a run, in the trash or not.

        Args:
            run_id: Id of the run.

        Returns:
            The path of the folder.

        Raises:
            UnknownRunError: If there is no such run.
        """
        if not is_run_id(run_id):
            raise UnknownRunError(f"There is no run {run_id!r:.80}.")
        return self._locate(self._database.get(run_id))

    def list(self, search: str = "", **filters: Any) -> RunPage:
        """Return one page of the list of runs.

        Args:
            search: Words that a run must contain, see `Query`.
            **filters: Other fields of `Query`.

        Returns:
            The page.

        Raises:
            ParameterError: If a field is invalid.
        """
        return self.query(Query(search, **filters))

    def _settle(self, entry: RunEntry) -> RunEntry:
        """Return an entry with "recording" removed if its recording has ended."""
        if entry.state != "recording":
            return entry
        recorder = self._recorders.get(entry.id)
        if recorder is None and self._is_indexing:
            return entry  # `index` is finishing it, or will soon
        failure = recorder.status.message if recorder and recorder.status.state == "failed" else ""
        return settle(self._database, self._locate(entry), entry, failure)

    def _locate(self, entry: RunEntry) -> Path:
        return (self._runs if entry.deleted is None else self._trash) / entry.id


def _fill(runs: Path, trash: Path, database: Database) -> None:
    # No method of a catalogue: the database would keep it and its file open.
    for _ in index_runs(database, runs, trash):
        pass


def _move(source: Path, target: Path) -> None:
    try:
        # Within one file system a rename is atomic: the run is never in both folders.
        source.replace(target)
    except FileNotFoundError:
        return
    except OSError as error:
        raise RecordError(f"Run {source.name} cannot be moved: {error}.") from None


def _format_time() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")
