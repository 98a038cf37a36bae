"""Execution of a study: spans of samples computed by workers and written to its folder."""

import os
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, wait
from concurrent.futures.process import BrokenProcessPool
from functools import partial

from svsa.evaluation.studies.rows import Span, count_done, find_missing, join_parts, write_part
from svsa.evaluation.studies.store import claim_study
from svsa.evaluation.studies.stored import StoredStudy, StudyError
from svsa.evaluation.studies.work import run_part
from svsa.evaluation.workers import start_workers

WORKERS = min(2, os.cpu_count() or 1)
ROWS_PER_PART = 1024

Part = tuple[Span, bytes]
"""Samples, and their rows as a Parquet file."""

RunParts = Callable[[StoredStudy, Iterator[Span]], Iterator[Part]]
"""Runs spans of a study and returns each once, in any order, when it is done. A span is requested
when a worker is free. A `KeyboardInterrupt` is raised after running parts are saved.
"""

Progress = Callable[[int, int], None]
"""Called with the numbers of finished and of all rows."""


def run_study(
    stored: StoredStudy,
    workers: int = WORKERS,
    rows_per_part: int = ROWS_PER_PART,
    progress: Progress = lambda done, total: None,
    is_cancelled: Callable[[], bool] = lambda: False,
    run_parts: RunParts | None = None,
) -> bool:
    """Run the missing part of a study; return whether it is then complete.

    Args:
        stored: The study.
        workers: Number of processes; 0 for this one.
        rows_per_part: Number of rows of a part.
        progress: Called with the number of finished rows.
        is_cancelled: Called before each part. If it returns True, and at Ctrl-C, parts in progress
            are completed and saved (on a cluster only finished ones are saved), and the function
            returns False.
        run_parts: Runs the parts instead of `workers`, for example a cluster.

    Returns:
        Whether the study is complete.

    Raises:
        StudyError: If another process runs the study, or a worker was killed.
    """
    laws = len(stored.study.laws)
    if run_parts is None:
        run_parts = partial(run_in_processes, workers) if workers else run_here
    with claim_study(stored):
        spans = _cut(find_missing(stored), max(1, rows_per_part // laws), is_cancelled)
        done, total = count_done(stored) * laws, stored.study.row_count
        progress(done, total)
        try:
            for (first, stop), content in run_parts(stored, spans):
                write_part(stored, (first, stop), content)
                done += (stop - first) * laws
                progress(done, total)
        except KeyboardInterrupt:
            return False
        finally:
            join_parts(stored)
    return not find_missing(stored)


def _cut(spans: list[Span], length: int, is_cancelled: Callable[[], bool]) -> Iterator[Span]:
    """Cut spans into pieces of at most this many samples, until cancelled."""
    for first, stop in spans:
        for begin in range(first, stop, length):
            if is_cancelled():
                return
            yield begin, min(begin + length, stop)


def run_here(stored: StoredStudy, spans: Iterator[Span]) -> Iterator[Part]:
    """Yield the parts of these spans, computed in this process."""
    for first, stop in spans:
        yield (first, stop), run_part(stored.study, first, stop - first)


def run_in_processes(workers: int, stored: StoredStudy, spans: Iterator[Span]) -> Iterator[Part]:
    """Yield the parts of these spans, computed by processes of low priority; after an
    interruption those in progress.
    """
    with start_workers(workers) as pool:
        begun: dict[Future[bytes], Span] = {}
        interrupted: KeyboardInterrupt | None = None
        while True:
            while interrupted is None and len(begun) < 2 * workers:
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
                begun = {future: span for future, span in begun.items() if not future.cancel()}
                continue
            for future in finished:
                try:
                    yield begun.pop(future), future.result()
                except BrokenProcessPool:
                    text = "A worker was ended from outside. Finished parts are kept: continue with"
                    raise StudyError(f"{text} `svsa study run {stored.name}`.") from None
        if interrupted is not None:
            raise interrupted
