"""Who runs the parts of a study: this process, or processes of this machine."""

from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, wait
from concurrent.futures.process import BrokenProcessPool

from svsa.evaluation.studies.store import Span, StoredStudy, StudyError
from svsa.evaluation.studies.work import run_part
from svsa.evaluation.workers import start_workers

Part = tuple[Span, bytes]
"""Draws, and their rows as a Parquet file."""

RunParts = Callable[[StoredStudy, Iterator[Span]], Iterator[Part]]
"""Runs spans of a study and gives each back once, in any order, as it is done. A span is taken
when somebody is free for it. A `KeyboardInterrupt` passes after the parts that are kept."""


def run_here(stored: StoredStudy, spans: Iterator[Span]) -> Iterator[Part]:
    """The parts of these spans, run in this process."""
    for first, stop in spans:
        yield (first, stop), run_part(stored.study, first, stop - first)


class Pool:
    """Processes of low priority; parts come back as they are done."""

    def __init__(self, workers: int) -> None:
        self._workers = workers

    def run_parts(self, stored: StoredStudy, spans: Iterator[Span]) -> Iterator[Part]:
        """The parts of these spans; after an interruption those that were being worked at."""
        with start_workers(self._workers) as pool:
            begun: dict[Future[bytes], Span] = {}
            interrupted: KeyboardInterrupt | None = None
            while True:
                while interrupted is None and len(begun) < 2 * self._workers:
                    span = next(spans, None)
                    if span is None:
                        break
                    begun[pool.submit(run_part, stored.study, span[0], span[1] - span[0])] = span
                if not begun:
                    break
                try:
                    finished, _ = wait(begun, return_when=FIRST_COMPLETED)
                except KeyboardInterrupt as error:
                    interrupted = error
                    begun = {one: span for one, span in begun.items() if not one.cancel()}
                    continue
                for one in finished:
                    try:
                        yield begun.pop(one), one.result()
                    except BrokenProcessPool:
                        text = "A worker was ended from outside. What is done is kept: go on with"
                        raise StudyError(f"{text} `svsa study run {stored.name}`.") from None
            if interrupted is not None:
                raise interrupted
