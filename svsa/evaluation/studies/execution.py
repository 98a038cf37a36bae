"""Execution of a study: spans of samples computed by workers and written to its folder."""

import os
from collections.abc import Callable, Iterator
from concurrent.futures.process import BrokenProcessPool
from functools import partial

from svsa.evaluation.campaign.runner import run_parts as run_by_workers
from svsa.evaluation.studies.rows import Span, count_done, find_missing, join_parts, write_part
from svsa.evaluation.studies.store import claim_study
from svsa.evaluation.studies.stored import StoredStudy, StudyError
from svsa.evaluation.studies.study import Study
from svsa.evaluation.studies.work import run_part

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
    run_parts = run_parts or partial(_run_parts, workers)
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


def _run_parts(workers: int, stored: StoredStudy, spans: Iterator[Span]) -> Iterator[Part]:
    """Yield the parts of these spans; after an interruption those in progress."""
    try:
        yield from run_by_workers(workers, partial(_run_span, stored.study), spans)
    except BrokenProcessPool:
        text = "A worker was ended from outside. Finished parts are kept: continue with"
        raise StudyError(f"{text} `svsa study run {stored.name}`.") from None


def _run_span(study: Study, span: Span) -> bytes:
    first, stop = span
    return run_part(study, first, stop - first)
