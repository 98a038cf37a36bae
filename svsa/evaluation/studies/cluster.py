"""Studies on a cluster: parts computed by the workers of a Dask cluster.

A part depends only on the study and its samples, so that the part of a lost worker is repeated by
another. Parts are transferred as the bytes that are stored: the client only writes them.
"""

import logging
import socket
import time
import uuid
from collections.abc import Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from typing import Any

from distributed import Client, Future, LocalCluster, WorkerPlugin, as_completed
from distributed.client import ClosedClientError
from distributed.comm.addressing import get_address_host_port, parse_address
from distributed.core import rpc
from distributed.scheduler import KilledWorker
from distributed.utils import LoopRunner

from svsa.errors import ParameterError, Violation
from svsa.evaluation.studies.execution import Part
from svsa.evaluation.studies.rows import Span
from svsa.evaluation.studies.stored import StoredStudy, StudyError
from svsa.evaluation.studies.study import Study
from svsa.evaluation.studies.work import run_part
from svsa.evaluation.workers import set_up_worker
from svsa.inputs.extras import __version__

LOCAL = "local"
"""In place of a scheduler's address: a cluster on this machine while the study runs."""
MIN_ROWS_A_PART, MAX_ROWS_A_PART = 1024, 8192
PARTS_A_THREAD = 8
"""Minimum number of parts per thread if there are enough rows, so that no thread waits long for the
last part.
"""
AHEAD = 2
"""Number of parts requested at once, per thread of the cluster."""
CONNECT_S = 10.0
WORKERS_S = 60.0
"""Time to wait for a scheduler's first worker, s."""
COUNTED_S = 2.0
"""Period at which the threads of the cluster are counted, because workers join and leave, s."""
LOST = (OSError, ClosedClientError, CancelledError)
"""Exceptions of a client whose scheduler is lost: a connection that was closed, refused or timed
out; and, after that, a cancelled part and a closed client.
"""


class Cluster:
    """The workers of a Dask scheduler."""

    def __init__(self, client: Client, address: str) -> None:
        self._client, self._address = client, address
        self._threads, self._counted = 0, 0.0
        self.count_threads()

    def count_threads(self, again: str = "") -> int:
        """Count the threads of all workers, at least 1.

        Raises:
            StudyError: If the scheduler is lost.
        """
        if time.monotonic() - self._counted > COUNTED_S or not self._threads:
            with self._ask(again):
                counted: Any = self._client.nthreads()
            self._threads = max(1, sum(counted.values()))
            self._counted = time.monotonic()
        return self._threads

    def choose_rows_per_part(self, rows: int) -> int:
        """Choose the rows per part, within `MIN_ROWS_A_PART` … `MAX_ROWS_A_PART`."""
        share = rows // (PARTS_A_THREAD * self.count_threads())
        return min(MAX_ROWS_A_PART, max(MIN_ROWS_A_PART, share))

    def run_parts(self, stored: StoredStudy, spans: Iterator[Span]) -> Iterator[Part]:
        """Yield the parts of these spans; after an interruption the finished ones.

        Raises:
            StudyError: If the scheduler is lost, if workers ended repeatedly while computing a
                part, or if a worker has another version of svsa, or none.
        """
        again = f"Finished parts are kept: continue with `svsa study run {stored.name}`."
        begun: dict[Future, Span] = {}
        done = as_completed(loop=self._client.loop)
        try:
            while True:
                while len(begun) < AHEAD * self.count_threads(again):
                    if (span := next(spans, None)) is None:
                        break
                    with self._ask(again):
                        future = self._submit(stored, span)
                    begun[future] = span
                    done.add(future)
                if not begun:
                    return
                future = next(done)
                yield begun.pop(future), self._read(future, again)
        except KeyboardInterrupt:
            finished = [future for future in begun if future.status == "finished"]
            with self._ask(again):
                self._client.cancel([future for future in begun if future not in finished])
            for done_future in finished:
                yield begun[done_future], self._read(done_future, again)
            raise

    def _submit(self, stored: StoredStudy, span: Span) -> Future:
        first, stop = span
        key = f"{stored.name}-{first}-{stop}-{uuid.uuid4().hex}"
        work = (_run_same_version, __version__, stored.study, first, stop - first)
        return self._client.submit(*work, key=key, pure=False)

    @contextmanager
    def _ask(self, again: str, asked: Future | None = None) -> Iterator[None]:
        """Raise `StudyError` if the scheduler is lost, but pass on errors of the work."""
        try:
            yield
        except LOST:
            if asked is not None and asked.status == "error":
                raise
            raise StudyError(
                f"The scheduler at {self._address} was lost. {again}".strip()
            ) from None

    def _read(self, future: Future, again: str) -> bytes:
        try:
            with self._ask(again, future):
                return future.result()
        except KilledWorker:
            raise StudyError(
                f"At {self._address} several workers ended during the same runs, possibly for"
                f" lack of memory. {again}"
            ) from None
        except ModuleNotFoundError as error:
            raise StudyError(
                f"A worker at {self._address} has no {error.name}: install svsa-lab {__version__}"
                f" there. {again}"
            ) from None


def _run_same_version(version: str, study: Study, first: int, count: int) -> bytes:
    """Run a part on a worker.

    Raises:
        StudyError: If its version differs.
    """
    if version != __version__:
        raise StudyError(
            f"A worker on {socket.gethostname()} has svsa {__version__}, and the study is run by"
            f" {version}: its runs might differ."
        )
    return run_part(study, first, count)


@contextmanager
def open_cluster(scheduler: str, workers: int) -> Iterator[Cluster]:
    """Connect to the scheduler at an address, such as tcp://10.0.0.1:8786.

    `LOCAL` starts a cluster of `workers` processes on this machine, reachable from it only, which
    ends with this process.

    Raises:
        ParameterError: If the address is invalid.
        StudyError: If no scheduler answers, or it has no worker.
    """
    if scheduler == LOCAL:
        with (
            LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                host="127.0.0.1",
                dashboard_address="127.0.0.1:0",
                silence_logs=logging.ERROR,
            ) as local,
            Client(local, set_as_default=False) as client,
        ):
            client.register_plugin(_WorkerSetup())
            yield Cluster(client, LOCAL)
        return
    _check_scheduler(scheduler)
    try:
        client = Client(scheduler, timeout=CONNECT_S, set_as_default=False)
    except (OSError, ImportError) as error:
        raise _refuse(scheduler, error) from None
    with client:
        try:
            client.wait_for_workers(1, WORKERS_S)
        except TimeoutError:
            raise StudyError(
                f"The scheduler at {scheduler} has no worker: start some with"
                f" `dask worker {scheduler} --nthreads 1`."
            ) from None
        except OSError as error:
            raise _refuse(scheduler, error) from None
        yield Cluster(client, scheduler)


class _WorkerSetup(WorkerPlugin):
    """Give a local worker a low priority, and leave Ctrl-C to its parent."""

    def setup(self, worker: Any) -> None:
        set_up_worker()


def _check_scheduler(address: str) -> None:
    """Check that a scheduler answers; its client would retry for long without a clear message."""
    try:
        scheme, _ = parse_address(address, strict=True)
        host, port = get_address_host_port(address, strict=True)
    except (ValueError, NotImplementedError, OSError) as error:
        bound = f"{LOCAL}, or an address such as tcp://10.0.0.1:8786 ({error})"
        raise ParameterError(Violation("scheduler", address, "", bound)) from None
    try:
        socket.create_connection((host, port), CONNECT_S).close()
    except OSError as error:
        raise _refuse(address, error) from None
    if scheme == "tcp":
        runner = LoopRunner()
        runner.start()
        try:
            kind = runner.run_sync(_ask_kind, address, callback_timeout=CONNECT_S)
        except OSError:
            raise _refuse(address, "the program there is not a Dask scheduler") from None
        finally:
            runner.stop()
        if kind != "Scheduler":
            raise _refuse(address, f"the program there is a {kind} of Dask")


async def _ask_kind(address: str) -> str:
    async with rpc(address) as there:
        identity: Any = await there.identity()
        return identity["type"]


def _refuse(address: str, why: object) -> StudyError:
    return StudyError(f"No Dask scheduler can be reached at {address}: {why}.")
