"""The paper's bench figures with several laws on the emulator, in parallel."""

import os
import signal
from collections.abc import Callable, Sequence
from concurrent.futures import Future, wait
from itertools import product
from multiprocessing.managers import SyncManager
from queue import Queue
from threading import Event

from svsa.errors import FaultError
from svsa.evaluation.ranking.bench_runs import NUMBERS, BenchRun, BenchRuns
from svsa.evaluation.ranking.measure import Report
from svsa.evaluation.ranking.row import RecoveryErrors
from svsa.evaluation.reproduction import compute_table_row
from svsa.evaluation.workers import choose_start, start_workers
from svsa.inputs.extras import __version__, require_extra
from svsa.runs.definition.paper import DURATION_S, get_figure
from svsa.runs.result.result import Result

POLL_S = 0.2
Job = tuple[str, str]
ReportOf = Callable[[int, float], None]


def measure_on_bench(
    laws: Sequence[str], figures: Sequence[str], report: Report = lambda done: None
) -> BenchRuns:
    """Run laws in figures, in as many processes as there are processors.

    `report` receives the finished share.

    Raises:
        MissingExtraError: Without the extra `bench`.
    """
    require_extra("bench")
    jobs = list(product(laws, figures))
    workers = min(len(jobs), os.cpu_count() or 1)
    shares = [0.0] * len(jobs)

    def note(number: int, share: float) -> None:
        shares[number] = share
        report(sum(shares) / len(jobs))

    if workers > 1:
        return BenchRuns(runs=_measure_side_by_side(jobs, workers, note))
    return BenchRuns(runs=tuple(measure_run(n, job, note) for n, job in enumerate(jobs)))


def measure_run(number: int, job: Job, report: ReportOf) -> BenchRun:
    """Run a law in a figure of 20 s, load at 5 s; `report` receives `number` and the finished
    share.
    """
    from svsa.hardware.emulator.experiment import run_on_emulator

    law, figure = job
    fault, errors = None, RecoveryErrors(**dict.fromkeys(NUMBERS))
    try:
        result = run_on_emulator(
            get_figure(figure), law, DURATION_S, lambda done: report(number, done)
        )
        errors = build_recovery_errors(result)
    except FaultError as error:
        fault = error.fault.code
    report(number, 1.0)
    return BenchRun(law=law, figure=figure, version=__version__, fault=fault, errors=errors)


def build_recovery_errors(result: Result) -> RecoveryErrors:
    """Compute the position errors of a run of 20 s in a figure of the paper, load at 5 s."""
    numbers = compute_table_row(result)
    return RecoveryErrors(
        before_deg=numbers["rms_position_before_deg"],
        peak_deg=numbers["peak_position_deg"],
        steady_deg=numbers["rms_position_steady_deg"],
        recovery_s=numbers["recovery_s"],
    )


def _measure_side_by_side(
    jobs: Sequence[Job], workers: int, report: ReportOf
) -> tuple[BenchRun, ...]:
    """Run processes in parallel, which report their progress through a queue.

    Only this process receives Ctrl-C; the runs and their emulators end at their next report.
    """
    manager = SyncManager(ctx=choose_start())
    manager.start(signal.signal, (signal.SIGINT, signal.SIG_IGN))
    with manager, start_workers(workers) as pool:
        progress, ends = manager.Queue(), manager.Event()
        futures = [
            pool.submit(_measure_apart, n, job, progress, ends) for n, job in enumerate(jobs)
        ]
        try:
            while wait(futures, POLL_S).not_done and not any(map(_has_failed, futures)):
                _pass_on(progress, report)
            _pass_on(progress, report)
            return tuple(future.result() for future in futures)
        finally:
            ends.set()
            pool.shutdown(cancel_futures=True)


def _has_failed(future: Future[BenchRun]) -> bool:
    return future.done() and future.exception() is not None


def _pass_on(progress: Queue[tuple[int, float]], report: ReportOf) -> None:
    while not progress.empty():
        report(*progress.get())


def _measure_apart(
    number: int, job: Job, progress: Queue[tuple[int, float]], ends: Event
) -> BenchRun:
    def report(number: int, share: float) -> None:
        if ends.is_set():
            raise KeyboardInterrupt
        progress.put((number, share))

    report(number, 0.0)
    return measure_run(number, job, report)
