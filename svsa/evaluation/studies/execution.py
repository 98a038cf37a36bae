"""Running a study: stretches of samples to whoever runs them, rows to its folder."""

import os
from collections.abc import Callable, Iterator

from svsa.evaluation.studies.pool import Pool, RunParts, run_here
from svsa.evaluation.studies.store import (
    Span,
    StoredStudy,
    claim_study,
    count_done,
    find_missing,
    join_parts,
    write_part,
)

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
    run_parts: RunParts | None = None,
) -> bool:
    """Run what is not done of a study; whether all of it is done then.

    workers: processes; 0 runs it in this one. is_cancelled: asked before each part; where it says
    so, and at Ctrl-C, the parts that are being worked at are waited for and kept (on a cluster
    those that are done are kept), and False is returned. run_parts: who runs it in place of
    `workers`, such as a cluster. Raises `StudyError` where another process works at it, and where a
    worker was ended.
    """
    laws = len(stored.study.laws)
    if run_parts is None:
        run_parts = Pool(workers).run_parts if workers else run_here
    with claim_study(stored):
        spans = _cut(find_missing(stored), max(1, rows_a_part // laws), is_cancelled)
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
    """Spans no longer than this many samples, until they are cancelled."""
    for first, stop in spans:
        for begin in range(first, stop, length):
            if is_cancelled():
                return
            yield begin, min(begin + length, stop)
