"""Execution of the parts of a campaign, in this process or in several."""

from collections.abc import Callable, Generator, Iterable
from concurrent.futures import FIRST_COMPLETED, Future, wait
from itertools import islice
from typing import TypeVar

from svsa.evaluation.workers import start_workers

AHEAD = 2
"""Number of parts requested at once, per process."""

P = TypeVar("P")
R = TypeVar("R")


def run_parts(
    workers: int, run: Callable[[P], R], parts: Iterable[P]
) -> Generator[tuple[P, R], None, None]:
    """Yield each part with its result, in the order of completion, if together in that of request.

    Args:
        workers: Number of processes of low priority; 0 for this one.
        run: Computes a part.
        parts: Requested when a worker is free. If the iterator is closed early, and at Ctrl-C, no
            further part begins, and those in progress are completed.

    Yields:
        A part and its result.

    Raises:
        KeyboardInterrupt: At Ctrl-C, after the parts in progress.
        BrokenProcessPool: If a process was ended from outside.
    """
    if not workers:
        yield from ((part, run(part)) for part in parts)
        return
    waiting, begun = iter(parts), dict[Future[R], P]()
    interruption: KeyboardInterrupt | None = None
    with start_workers(workers) as pool:
        try:
            while True:
                if interruption is None:
                    for part in islice(waiting, AHEAD * workers - len(begun)):
                        begun[pool.submit(run, part)] = part
                if not begun:
                    break
                try:
                    wait(begun, return_when=FIRST_COMPLETED)
                except KeyboardInterrupt as error:
                    interruption = error
                    begun = {future: part for future, part in begun.items() if not future.cancel()}
                    continue
                for future in [future for future in begun if future.done()]:
                    yield begun.pop(future), future.result()
        finally:
            pool.shutdown(cancel_futures=True)
    if interruption is not None:
        raise interruption
