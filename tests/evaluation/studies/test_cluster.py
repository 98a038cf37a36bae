"""A study on a Dask cluster: workers, and a scheduler that ends, as processes of their own."""

import contextlib
import json
import signal
import socket
import subprocess
import sys
import threading

import pytest
from distributed import Client, LocalCluster
from typer.testing import CliRunner

from svsa.cli import app
from svsa.errors import ParameterError
from svsa.evaluation.studies import cluster as dask
from svsa.evaluation.studies.cluster import open_cluster
from svsa.evaluation.studies.execution import run_study
from svsa.evaluation.studies.store import (
    StudyError,
    find_missing,
    keep_study,
    open_study,
    read_rows,
)
from tests.evaluation.studies.ended import end_on_the_way
from tests.evaluation.studies.studies import build_study
from tests.waiting import wait_until

pytestmark = pytest.mark.long
TRIALS = 400
LOOPBACK = ("--host", "127.0.0.1", "--no-dashboard")
WAIT_S = 300.0


def begin(*command):
    program = (sys.executable, "-m", "dask", *command)
    return subprocess.Popen(program, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def begin_worker(address, name):
    alone = ("--nthreads", "1", "--no-nanny", "--name", name)
    return begin("worker", address, *LOOPBACK, *alone)


@contextlib.contextmanager
def run_scheduler(folder):
    """A scheduler's address and its process."""
    reported = folder / "scheduler.json"
    process = begin("scheduler", *LOOPBACK, "--port", "0", "--scheduler-file", str(reported))
    try:
        wait_until(reported.exists)
        wait_until(lambda: reported.read_text().endswith("}"))
        yield json.loads(reported.read_text())["address"], process
    finally:
        process.kill()
        process.wait()


@contextlib.contextmanager
def run_scheduler_here():
    """The address of a scheduler in this process, reached over a socket like any."""
    with LocalCluster(n_workers=0, host="127.0.0.1", dashboard_address="127.0.0.1:0") as here:
        yield here.scheduler_address


@pytest.fixture(scope="module")
def cluster():
    """The address of a scheduler of this process with two workers, and these, by name."""
    with run_scheduler_here() as address:
        workers = {name: begin_worker(address, name) for name in ("a", "b")}
        with Client(address, set_as_default=False) as client:
            client.wait_for_workers(2, WAIT_S)
        yield address, workers
        for process in workers.values():
            process.kill()
            process.wait()


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The bytes of the table as one process runs it in one go."""
    stored = keep_study("one", build_study(runs=TRIALS), tmp_path_factory.mktemp("whole"))
    assert run_study(stored, 0, 2 * TRIALS)
    return read_table(stored)


def read_table(stored):
    return (stored.folder / "rows.parquet").read_bytes()


@pytest.mark.exhaustive
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_a_client_that_was_ended_leaves_what_another_goes_on_with(cluster, whole, tmp_path, how):
    address, _ = cluster
    stored = end_on_the_way(tmp_path, how, address)
    with open_cluster(address, 0) as there:
        assert run_study(stored, rows_a_part=40, run_parts=there.run_parts)
    assert read_table(stored) == whole


@pytest.mark.exhaustive
def test_what_a_lost_worker_had_is_run_by_another_once(cluster, whole, tmp_path):
    """It is held first, so that it has parts when it is killed, and given no chance to finish."""
    address, workers = cluster
    stored = keep_study("one", build_study(runs=TRIALS), tmp_path)
    had, reported = [], []
    with Client(address, set_as_default=False) as watcher, open_cluster(address, 0) as there:
        info = watcher.scheduler_info(n_workers=-1)["workers"]
        own = next(at for at, worker in info.items() if worker["name"] == "a")

        def kill():
            wait_until(lambda: watcher.processing()[own])
            had.extend(watcher.processing()[own])
            workers["a"].kill()

        killer = threading.Thread(target=kill)

        def report(done, total):
            reported.append(done)
            if len(reported) == 2:
                workers["a"].send_signal(signal.SIGSTOP)
                killer.start()

        assert run_study(stored, rows_a_part=16, progress=report, run_parts=there.run_parts)
        killer.join()
    assert had
    assert reported == [16 * number for number in range(2 * TRIALS // 16 + 1)]
    assert read_table(stored) == whole


@pytest.mark.exhaustive
def test_a_study_outlives_its_scheduler(whole, tmp_path):
    stored = keep_study("one", build_study(runs=TRIALS), tmp_path)
    with run_scheduler(tmp_path) as (address, process):
        worker = begin_worker(address, "a")

        def report(done, total):
            if done == 48:
                process.kill()

        try:
            with (
                pytest.raises(StudyError, match=rf"{address} was lost.*svsa study run one"),
                open_cluster(address, 0) as there,
            ):
                run_study(stored, rows_a_part=16, progress=report, run_parts=there.run_parts)
        finally:
            worker.kill()
            worker.wait()
    assert len(read_rows(stored)) >= 48
    assert run_study(stored, 0)
    assert read_table(stored) == whole


def test_a_worker_of_another_version_is_refused(cluster, tmp_path, monkeypatch):
    address, _ = cluster
    stored = keep_study("one", build_study(), tmp_path)
    monkeypatch.setattr(dask, "__version__", "99.0")
    with open_cluster(address, 0) as there, pytest.raises(StudyError, match=r"run by 99\.0"):
        run_study(stored, rows_a_part=16, run_parts=there.run_parts)
    assert find_missing(stored) == [(0, 40)]


@pytest.mark.exhaustive
def test_the_command_runs_a_study_on_a_cluster_of_this_machine(whole, tmp_path, monkeypatch):
    monkeypatch.setenv("SVSA_DATA", str(tmp_path))
    keep_study("one", build_study(runs=TRIALS))
    run = ["study", "run", "one", "--scheduler", "local", "--workers", "1"]
    outcome = CliRunner().invoke(app, run, catch_exceptions=False)
    assert outcome.exit_code == 0
    assert read_table(open_study("one")) == whole


def test_a_cluster_that_has_workers_is_given_none(tmp_path, monkeypatch):
    """And nothing is begun."""
    monkeypatch.setenv("SVSA_DATA", str(tmp_path))
    run = ["study", "run", "gains", "--scheduler", "tcp://127.0.0.1:1", "--workers", "3"]
    with pytest.raises(ParameterError, match="--workers is 3: it must be left out"):
        CliRunner().invoke(app, run, catch_exceptions=False)
    assert not list(tmp_path.iterdir())


def test_parts_are_of_a_thousand_runs_at_least_and_several_a_thread(cluster):
    with open_cluster(cluster[0], 0) as there:
        threads = there.count_threads()
        assert there.choose_rows_a_part(2000) == 1024
        assert there.choose_rows_a_part(8 * threads * 3000) == 3000
        assert there.choose_rows_a_part(10**9) == 8192


def test_an_address_without_a_scheduler_is_a_plain_error_that_names_it(cluster, monkeypatch):
    with socket.socket() as free, pytest.raises(StudyError) as refused:
        free.bind(("127.0.0.1", 0))
        address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
        with open_cluster(address, 0):
            pass
    assert address in str(refused.value)
    with pytest.raises(ParameterError, match=r"scheduler is 'foo': .* an address"):
        open_cluster("foo", 0).__enter__()
    with Client(cluster[0], set_as_default=False) as client:
        worker = next(iter(client.nthreads()))
    with pytest.raises(StudyError, match=f"{worker}.* is a Worker of Dask"):
        open_cluster(worker, 0).__enter__()


def test_a_scheduler_without_workers_says_how_to_begin_one(monkeypatch):
    monkeypatch.setattr(dask, "WORKERS_S", 0.2)
    with run_scheduler_here() as address, pytest.raises(StudyError, match="dask worker"):
        open_cluster(address, 0).__enter__()
