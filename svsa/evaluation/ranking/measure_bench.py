"""The paper's bench figures with several laws on the emulator, in parallel."""

import os
from collections.abc import Callable, MutableSequence, Sequence
from concurrent.futures import Future, wait
from functools import partial
from itertools import product
from multiprocessing.synchronize import Event

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
    if workers > 1:
        return BenchRuns(runs=_measure_side_by_side(jobs, workers, report))

    def note(number: int, share: float) -> None:
        report((number + share) / len(jobs))

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
    jobs: Sequence[Job], workers: int, report: Report
) -> tuple[BenchRun, ...]:
    """Run processes in parallel, which write the finished share of each run to shared memory.

    Only this process receives Ctrl-C; the runs and their emulators end at their next report.
    """
    context = choose_start()
    shares, ends = context.Array("d", len(jobs), lock=False), context.Event()
    with start_workers(workers, begin=partial(_attach_shared, shares, ends)) as pool:
        try:
            futures = [pool.submit(_measure_apart, n, job) for n, job in enumerate(jobs)]
            while wait(futures, POLL_S).not_done and not any(map(_has_failed, futures)):
                report(sum(shares) / len(jobs))
            report(sum(shares) / len(jobs))
            return tuple(future.result() for future in futures)
        finally:
            ends.set()
            pool.shutdown(cancel_futures=True)


def _has_failed(future: Future[BenchRun]) -> bool:
    return future.done() and future.exception() is not None


_shared: tuple[MutableSequence[float], Event]
"""In a worker: the finished share of each job, and whether the runs end."""


def _attach_shared(shares: MutableSequence[float], ends: Event) -> None:
    global _shared
    _shared = shares, ends


def _measure_apart(number: int, job: Job) -> BenchRun:
    shares, ends = _shared

    def report(number: int, share: float) -> None:
        if ends.is_set():
            raise KeyboardInterrupt
        shares[number] = share

    report(number, 0.0)
    return measure_run(number, job, report)
