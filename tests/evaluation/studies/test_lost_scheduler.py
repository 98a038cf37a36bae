"""A lost scheduler differs from an error of the work. A scheduler in this process fails its calls
as those over a broken connection fail before the client detects it.
"""

import concurrent.futures
import re

import pytest
from distributed import Client, LocalCluster
from distributed.comm.core import CommClosedError

from svsa.evaluation.studies import cluster as dask
from svsa.evaluation.studies.cluster import Cluster
from svsa.evaluation.studies.store import keep_study
from svsa.evaluation.studies.stored import StudyError
from tests.evaluation.studies.studies import build_study

LOST = r"The scheduler at inproc was lost\. Finished parts are kept: .*`svsa study run one`"
BROKEN = (
    CommClosedError("in <TCP (closed)>: Stream is closed"),
    OSError("Timed out trying to connect to tcp://127.0.0.1:8786 after 30 s"),
    concurrent.futures.CancelledError(),
)


class BrokenScheduler:
    """The scheduler of a client that raises an error in these calls, or in all."""

    def __init__(self, whole, error, *calls):
        self._whole, self._error, self._calls = whole, error, calls

    def __getattr__(self, name):
        if self._calls and name not in self._calls:
            return getattr(self._whole, name)
        return self._fail

    async def _fail(self, **_):
        raise self._error


@pytest.fixture(scope="module")
def workers():
    """A worker of this process that runs nothing: each part has the same bytes."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(dask, "run_part", lambda study, first, count: b"rows")
        alone = {"n_workers": 1, "threads_per_worker": 1, "processes": False}
        with LocalCluster(**alone, dashboard_address="127.0.0.1:0") as local:
            yield local


@pytest.fixture
def client(workers):
    with Client(workers, set_as_default=False) as one:
        yield one


@pytest.fixture
def parts(client, tmp_path):
    """The parts of a study of 40 rows, four at a time."""
    stored = keep_study("one", build_study(), tmp_path)
    spans = ((first, first + 4) for first in range(0, 40, 4))
    return Cluster(client, "inproc").run_parts(stored, spans)


@pytest.mark.parametrize("error", BROKEN, ids=lambda error: type(error).__name__)
def test_broken_connection_after_a_finished_part_is_a_lost_scheduler(client, parts, error):
    assert next(parts)[1] == b"rows"
    client.scheduler = BrokenScheduler(client.scheduler, error, "gather")
    with pytest.raises(StudyError, match=LOST):
        list(parts)


def test_broken_connection_during_the_thread_count_is_a_lost_scheduler(client, parts, monkeypatch):
    next(parts)
    monkeypatch.setattr(dask, "COUNTED_S", 0.0)
    client.scheduler = BrokenScheduler(client.scheduler, BROKEN[0], "ncores")
    with pytest.raises(StudyError, match=LOST):
        list(parts)
    with pytest.raises(StudyError, match=r"inproc was lost\.$"):
        Cluster(client, "inproc")


def test_closed_client_is_a_lost_scheduler(client, parts):
    next(parts)
    client.close()
    with pytest.raises(StudyError, match=LOST):
        list(parts)


@pytest.mark.parametrize("error", BROKEN[:2], ids=lambda error: type(error).__name__)
def test_error_of_the_work_is_raised_unchanged(parts, monkeypatch, error):
    def fail(study, first, count):
        raise error

    monkeypatch.setattr(dask, "run_part", fail)
    with pytest.raises(type(error), match=re.escape(str(error))):
        list(parts)
