"""Recordings of the sessions: started, finished in the background, opened as branches."""

import asyncio
import logging
from collections.abc import Callable
from typing import Any, NoReturn

import svsa
from svsa.control.gains import Gains
from svsa.runs.records.catalogue.entry import CatalogueError
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import RecordHeader, build_header
from svsa.runs.records.recorder import Recorder
from svsa.runs.session.session import Session

FINISH_TIMEOUT_S = 10.0

_log = logging.getLogger("svsa")


class NoCatalogue:
    """Replaces a catalogue that could not be opened: every use reports why; control continues."""

    def __init__(self, reason: str) -> None:
        self._reason = reason

    def __getattr__(self, _: str) -> Callable[..., NoReturn]:
        def refuse(*_: Any, **__: Any) -> NoReturn:
            raise CatalogueError(self._reason)

        return refuse


def open_catalogue() -> Catalogue | NoCatalogue:
    """Open the catalogue in SVSA_DATA; `Indexing` completes interrupted records."""
    try:
        return Catalogue()
    except CatalogueError as error:
        _log.warning("Nothing can be recorded. %s", error)
        return NoCatalogue(str(error))


class Recordings:
    """Starts recordings, and completes their files in the background."""

    def __init__(self, catalogue: Catalogue | NoCatalogue) -> None:
        self._catalogue = catalogue
        self._finishing: set[asyncio.Task[None]] = set()

    async def start(
        self, session: Session, name: str, tags: tuple[str, ...], notes: str, owner: str = ""
    ) -> str:
        """Start to record a session, and return the id of the run; `owner` is the id of the user.

        Raises:
            StateError: If the session cannot be recorded.
            RecordError: If the record cannot be written.
            ParameterError: If name, tags or notes are invalid.
        """
        session.prepare_recording()
        header = build_session_header(session, name, tags, notes, owner)
        recorder = await asyncio.to_thread(self._catalogue.record, header)
        session.journal.on_recorded = self.finish
        try:
            session.start_recording(recorder)
        except svsa.StateError:
            self.finish(recorder)
            raise
        return header.run_id

    def finish(self, recorder: Recorder) -> None:
        """Complete the file and the entry of an ended recording in the background."""
        task = asyncio.get_running_loop().create_task(self._finish(recorder))
        self._finishing.add(task)
        task.add_done_callback(self._finishing.discard)

    async def close(self) -> None:
        """Wait for files in completion; the next start does the rest."""
        if self._finishing:
            await asyncio.wait(self._finishing, timeout=FINISH_TIMEOUT_S)

    async def _finish(self, recorder: Recorder) -> None:
        status = await asyncio.to_thread(recorder.close)
        # `close` returns after 5 s at most; for a long file it is called again.
        while status.state == "recording":
            status = await asyncio.to_thread(recorder.close)
        try:
            await asyncio.to_thread(self._catalogue.finish, recorder.header.run_id, status)
        except svsa.SvsaError as error:
            _log.warning("Run %s was not entered: %s", recorder.header.run_id, error)


def build_session_header(
    session: Session, name: str, tags: tuple[str, ...], notes: str, owner: str = ""
) -> RecordHeader:
    """Build the header of a session's record.

    Unstable gains, which a private session permits, are rejected: their record could not be opened
    again.

    Raises:
        ParameterError: If a value is invalid.
    """
    Gains(**dict(session.journal.initial.gains))
    return build_header(
        session.journal.initial,
        len(session.run.lanes),
        session=session.name,
        plant=session.plant,
        name=name,
        tags=tags if session.plant == "simulated" else tuple(dict.fromkeys((*tags, session.plant))),
        notes=notes,
        owner=owner,
        branch_of=session.journal.branch_of,
    )
