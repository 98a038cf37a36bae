"""A study on a Dask cluster: workers, and a scheduler that ends, in separate processes."""

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
from svsa.evaluation.studies.rows import find_missing, read_rows
from svsa.evaluation.studies.store import keep_study, open_study
from svsa.evaluation.studies.stored import StudyError
from tests.evaluation.studies.ended import end_before_completion
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
    """Run a scheduler; return its address and its process."""
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
    """Run a scheduler in this process; return its address, which clients reach over a socket."""
    with LocalCluster(n_workers=0, host="127.0.0.1", dashboard_address="127.0.0.1:0") as here:
        yield here.scheduler_address


@pytest.fixture(scope="module")
def cluster():
    """Run a scheduler of this process with two workers: its address, and the workers by name."""
    with run_scheduler_here() as address:
        workers = {name: begin_worker(address, name) for name in ("a", "b")}
        with Client(address, set_as_default=False) as client:
            client.wait_for_workers(2, WAIT_S)
        yield address, workers
        for process in workers.values():
            process.kill()
            process.wait()


@pytest.fixture(scope="module")
def single_process_table(tmp_path_factory):
    """The bytes of the table of one uninterrupted process."""
    stored = keep_study(
        "one", build_study(runs=TRIALS), tmp_path_factory.mktemp("single_process_table")
    )
    assert run_study(stored, 0, 2 * TRIALS)
    return read_table(stored)


def read_table(stored):
    return (stored.folder / "rows.parquet").read_bytes()


@pytest.mark.exhaustive
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_ended_client_leaves_results_that_another_continues(
    cluster, single_process_table, tmp_path, how
):
    address, _ = cluster
    stored = end_before_completion(tmp_path, how, address)
    with open_cluster(address, 0) as there:
        assert run_study(stored, rows_per_part=40, run_parts=there.run_parts)
    assert read_table(stored) == single_process_table


@pytest.mark.exhaustive
def test_part_of_a_lost_worker_is_run_once_by_another(cluster, single_process_table, tmp_path):
    """The worker is paused first, so that it has parts when it is killed and cannot finish them."""
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

        assert run_study(stored, rows_per_part=16, progress=report, run_parts=there.run_parts)
        killer.join()
    assert had
    assert reported == [16 * number for number in range(2 * TRIALS // 16 + 1)]
    assert read_table(stored) == single_process_table


@pytest.mark.exhaustive
def test_study_continues_after_a_restart_of_its_scheduler(single_process_table, tmp_path):
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
                run_study(stored, rows_per_part=16, progress=report, run_parts=there.run_parts)
        finally:
            worker.kill()
            worker.wait()
    assert len(read_rows(stored)) >= 48
    assert run_study(stored, 0)
    assert read_table(stored) == single_process_table


def test_worker_of_another_version_is_rejected(cluster, tmp_path, monkeypatch):
    address, _ = cluster
    stored = keep_study("one", build_study(), tmp_path)
    monkeypatch.setattr(dask, "__version__", "99.0")
    with open_cluster(address, 0) as there, pytest.raises(StudyError, match=r"run by 99\.0"):
        run_study(stored, rows_per_part=16, run_parts=there.run_parts)
    assert find_missing(stored) == [(0, 40)]


@pytest.mark.exhaustive
def test_command_runs_a_study_on_a_cluster_of_this_machine(
    single_process_table, tmp_path, monkeypatch
):
    monkeypatch.setenv("SVSA_DATA", str(tmp_path))
    keep_study("one", build_study(runs=TRIALS))
    run = ["study", "run", "one", "--scheduler", "local", "--workers", "1"]
    outcome = CliRunner().invoke(app, run, catch_exceptions=False)
    assert outcome.exit_code == 0
    assert read_table(open_study("one")) == single_process_table


def test_no_workers_are_started_for_a_cluster_with_workers(tmp_path, monkeypatch):
    """And no study is started."""
    monkeypatch.setenv("SVSA_DATA", str(tmp_path))
    run = ["study", "run", "gains", "--scheduler", "tcp://127.0.0.1:1", "--workers", "3"]
    with pytest.raises(ParameterError, match="--workers is 3: it must be omitted"):
        CliRunner().invoke(app, run, catch_exceptions=False)
    assert not list(tmp_path.iterdir())


def test_parts_have_at_least_a_thousand_runs_and_several_per_thread(cluster):
    with open_cluster(cluster[0], 0) as there:
        threads = there.count_threads()
        assert there.choose_rows_per_part(2000) == 1024
        assert there.choose_rows_per_part(8 * threads * 3000) == 3000
        assert there.choose_rows_per_part(10**9) == 8192


def test_address_without_a_scheduler_is_reported(cluster, monkeypatch):
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


@pytest.mark.exhaustive
@pytest.mark.long
def test_scheduler_without_workers_reports_how_to_start_one(monkeypatch):
    monkeypatch.setattr(dask, "WORKERS_S", 0.2)
    with run_scheduler_here() as address, pytest.raises(StudyError, match="dask worker"):
        open_cluster(address, 0).__enter__()
