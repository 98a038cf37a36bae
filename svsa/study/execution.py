"""Running a study: stretches of draws to processes of low priority, rows to its folder."""

import multiprocessing
import os
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool

import pyarrow as pa

from svsa.study.store import (
    Span,
    StoredStudy,
    StudyError,
    claim_study,
    count_done,
    find_missing,
    join_parts,
    write_part,
)
from svsa.study.study import Study
from svsa.study.work import run_draws
from svsa.worker_process import give_way

WORKERS = min(2, os.cpu_count() or 1)
ROWS_A_PART = 1024

Progress = Callable[[int, int], None]
"""Told how many rows are done, and of how many."""


def run_study(
    stored: StoredStudy,
    workers: int = WORKERS,
    rows_a_part: int = ROWS_A_PART,
    progress: Progress = lambda done, total: None,
    is_cancelled: Callable[[], bool] = lambda: False,
) -> bool:
    """Run what is not done of a study; whether all of it is done then.

    workers: processes; 0 runs it in this one. is_cancelled: asked before each part; where it says
    so, and at Ctrl-C, the parts that are being worked at are waited for and kept, and False is
    returned. Raises `StudyError` where another process works at it, and where a worker was ended.
    """
    laws = len(stored.study.laws)
    with claim_study(stored):
        spans = _cut(find_missing(stored), max(1, rows_a_part // laws), is_cancelled)
        done, total = count_done(stored) * laws, stored.study.row_count
        progress(done, total)
        parts = (
            _run_here(stored.study, spans) if workers == 0 else _Pool(workers).run(stored, spans)
        )
        try:
            for span, table in parts:
                write_part(stored, span, table)
                done += len(table)
                progress(done, total)
        except KeyboardInterrupt:
            return False
        finally:
            join_parts(stored)
    return not find_missing(stored)


def _cut(spans: list[Span], length: int, is_cancelled: Callable[[], bool]) -> Iterator[Span]:
    """Spans no longer than this many draws, until they are cancelled."""
    for first, stop in spans:
        for begin in range(first, stop, length):
            if is_cancelled():
                return
            yield begin, min(begin + length, stop)


def _run_here(study: Study, spans: Iterator[Span]) -> Iterator[tuple[Span, pa.Table]]:
    for first, stop in spans:
        yield (first, stop), run_draws(study, first, stop - first)


class _Pool:
    """Processes of low priority; parts come back as they are done."""

    def __init__(self, workers: int) -> None:
        self._workers = workers
        self._stopped = False

    def run(self, stored: StoredStudy, spans: Iterator[Span]) -> Iterator[tuple[Span, pa.Table]]:
        """The parts of these spans; after an interruption those that were being worked at."""
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(self._workers, context, give_way) as pool:
            begun: dict[Future[pa.Table], Span] = {}
            interrupted: KeyboardInterrupt | None = None
            while True:
                while interrupted is None and len(begun) < 2 * self._workers:
                    span = next(spans, None)
                    if span is None:
                        break
                    begun[pool.submit(run_draws, stored.study, span[0], span[1] - span[0])] = span
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
