"""Update the list of runs in the background."""

import logging
import threading
import time
from collections.abc import Callable

from svsa.runs.records.catalogue.entry import CatalogueError
from svsa.runs.records.catalogue.runs import Catalogue
from svsa_server.schemas.runs.run import IndexProgress
from svsa_server.sessions.recording import NoCatalogue

REPORT_S = 5.0
_log = logging.getLogger("svsa")


class Indexing:
    """Reads new, changed or interrupted runs in a thread; see `Catalogue.index`.

    It sleeps half of the time, so that thousands of runs do not delay a loop on the same machine.

    Args:
        catalogue: The runs.
        report: Called with a line of text every few seconds, if it takes that long.
    """

    def __init__(
        self, catalogue: Catalogue | NoCatalogue, report: Callable[[str], None] = _log.info
    ) -> None:
        self._catalogue, self._report = catalogue, report
        self._stop = threading.Event()
        self._indexed: IndexProgress | None = IndexProgress(done=0, total=0)
        self._thread = threading.Thread(target=self._run, name="index of runs", daemon=True)
        self._thread.start()

    @property
    def progress(self) -> IndexProgress | None:
        """Progress; None once the list is complete."""
        return self._indexed

    def wait(self) -> None:
        """Wait until the list is complete."""
        self._thread.join()

    def close(self) -> None:
        """Stop after the current run; the next start does the rest."""
        self._stop.set()
        self.wait()

    def _run(self) -> None:
        try:
            self._index()
        except (CatalogueError, OSError) as error:
            _log.warning("The list of runs is not complete. %s", error)
        self._indexed = None

    def _index(self) -> None:
        if isinstance(self._catalogue, NoCatalogue):
            return
        total = 0
        begin = last_report = before = time.monotonic()
        for done, total in self._catalogue.index():
            self._indexed = IndexProgress(done=done, total=total)
            now = time.monotonic()
            if now - last_report > REPORT_S:
                last_report = now
                self._report(f"Indexing recorded runs: {done} of {total}.")
            if self._stop.wait(now - before):
                return
            before = time.monotonic()
        if last_report > begin:
            self._report(f"The list of runs is complete: {total} were indexed.")
