"""Exports, replays and comparisons in separate processes: limited, and errors are returned."""

import asyncio
import os
import pickle
import threading
import time

import pytest

from svsa.errors import ParameterError, Violation
from svsa.evaluation.workers import start_workers
from svsa_server.jobs import heavy_work
from svsa_server.jobs.heavy_work import RETRY_AFTER_S, BusyError, HeavyWork
from svsa_server.problems import TYPE_PREFIX
from tests.lab import PROGRAM, Lab, run_lab
from tests.lab_in_process import run_lab_in_process
from tests.server.jobs.done_by_workers import end, get_process, note_and_sleep, refuse, wait_for
from tests.waiting import follow_recording, is_running, wait_until


@pytest.fixture
def work():
    work = HeavyWork(most=2, workers=1)
    yield work
    work.close()


def test_job_runs_in_another_process_of_the_lowest_priority(work):
    process, niceness = asyncio.run(work.run(get_process))
    assert process != os.getpid()
    assert niceness == 10


def test_idle_worker_ends_and_the_next_job_starts_another(work, monkeypatch, tmp_path):
    monkeypatch.setattr(heavy_work, "IDLE_S", 0.1)

    async def work_twice():
        first, _ = await work.run(get_process)
        waiting = asyncio.create_task(work.run(wait_for, tmp_path / "go"))
        await asyncio.sleep(0.2)  # A worker that works is not idle.
        (tmp_path / "go").touch()
        await waiting
        while work._pool is not None:
            await asyncio.sleep(0.01)
        second, _ = await work.run(get_process)
        return first, second

    first, second = asyncio.run(asyncio.wait_for(work_twice(), 60.0))
    assert first != second
    wait_until(lambda: not is_running(first))


def test_full_queue_is_reported_and_queued_jobs_are_completed(work, tmp_path):
    async def crowd():
        first = [asyncio.create_task(work.run(wait_for, tmp_path / "go")) for _ in range(2)]
        await asyncio.sleep(0)
        with pytest.raises(BusyError, match=r"2 exports.*try again in 5 s"):
            await work.run(get_process)
        (tmp_path / "go").touch()
        await asyncio.gather(*first)
        await work.run(get_process)

    asyncio.run(crowd())


def test_server_answers_while_its_first_worker_starts(work, monkeypatch):
    """A worker is forked from a process that first imports for seconds, longer on a busy
    machine.
    """
    has_answered = threading.Event()

    def begin_slowly(*asked):
        assert has_answered.wait(timeout=30), "the loop stands still until the worker has begun"
        return start_workers(*asked)

    monkeypatch.setattr(heavy_work, "start_workers", begin_slowly)

    async def answer_meanwhile():
        job = asyncio.create_task(work.run(get_process))
        await asyncio.sleep(0.01)
        has_answered.set()
        await job

    asyncio.run(answer_meanwhile())


def test_ended_lab_starts_no_job(work):
    work.close()
    with pytest.raises(BusyError, match="is shutting down"):
        asyncio.run(work.run(get_process))


@pytest.mark.exhaustive
def test_server_stopped_while_its_first_worker_starts_ends_without_an_error(tmp_path):
    """On a busy machine a worker starts for longer than the sessions may be silent at the end."""
    program = (
        "import pathlib, time; from svsa_server import responsive; from svsa_server.jobs import"
        " heavy_work as work; start = work.start_workers; responsive.END_SILENT_S = 0.5;"
        f" note = pathlib.Path({str(tmp_path / 'starting')!r});"
        " work.start_workers = lambda *a: (note.touch(), time.sleep(3), start(*a))[2]; "
    )
    with run_lab(program=program + PROGRAM) as lab:
        tuning = {"kind": "tuning", "law": "pd", "budget": 2}
        lab.client.post("/api/v1/jobs", json=tuning).raise_for_status()
        wait_until((tmp_path / "starting").exists)
    # The end of the lab has asserted its exit code.


def test_rejection_is_returned_with_its_values(work):
    with pytest.raises(ParameterError) as refused:
        asyncio.run(work.run(refuse, "frequency_hz"))
    assert refused.value.violations == (Violation("frequency_hz", 9.0, "Hz", "at most 5 Hz"),)
    again = pickle.loads(pickle.dumps(refused.value))  # noqa: S301
    assert str(again) == str(refused.value)


def test_worker_that_dies_is_replaced(work):
    with pytest.raises(BusyError, match="has ended"):
        asyncio.run(work.run(end))
    assert asyncio.run(work.run(get_process))[0] != os.getpid()


def test_end_of_one_lab_ends_no_worker_of_another(work, tmp_path):
    """Two in one process, as in these tests; its own worker ends during a job."""
    note = tmp_path / "begun"
    process, _ = asyncio.run(work.run(get_process))

    async def close_in_the_middle() -> None:
        ending = HeavyWork(most=1, workers=1)
        job = asyncio.create_task(ending.run(note_and_sleep, note))
        await asyncio.to_thread(wait_until, note.exists)
        other = await work.run(get_process)
        ending.close()
        with pytest.raises(BusyError, match="has ended"):
            await job
        assert other[0] == process

    asyncio.run(close_in_the_middle())
    assert asyncio.run(work.run(get_process))[0] == process


@pytest.fixture(scope="module")
def busy_lab():
    with run_lab_in_process(max_exports="0") as lab:
        yield lab


def record(lab: Lab, seconds: int) -> str:
    lab.load_figure()
    lab.client.post(lab.session + "/pause").raise_for_status()
    began = lab.client.post(lab.session + "/recording", json={"name": "long"}).json()
    lab.jump(seconds)
    lab.client.delete(lab.session + "/recording").raise_for_status()
    run_id = began["recording"]["run_id"]
    follow_recording(lab.client, f"/api/v1/runs/{run_id}")
    return run_id


def test_full_queue_is_a_503_with_a_retry_time(busy_lab: Lab) -> None:
    run_id = record(busy_lab, 1)
    for method, path in (
        ("GET", "export?kind=csv"),
        ("GET", "replay"),
        ("GET", "export?kind=html"),
        ("POST", "verify"),
    ):
        answer = busy_lab.client.request(method, f"/api/v1/runs/{run_id}/{path}")
        assert answer.status_code == 503, path
        assert answer.headers["retry-after"] == str(RETRY_AFTER_S)
        assert answer.json()["type"] == TYPE_PREFIX + "busy"


@pytest.mark.wall_clock
def test_live_sessions_are_not_late_while_a_replay_is_built(shared_lab: Lab) -> None:
    run_id = record(shared_lab, 20)
    shared_lab.load_figure()
    before = shared_lab.read()
    began = time.monotonic()
    path = f"/api/v1/runs/{run_id}/export?kind=html"
    page = shared_lab.client.get(path, timeout=300)
    while page.status_code == 503 and time.monotonic() - began < 120:
        time.sleep(
            float(page.headers["Retry-After"])
        )  # requests of earlier tests are answered first
        page = shared_lab.client.get(path, timeout=300)
    page.raise_for_status()
    waited, after = time.monotonic() - began, shared_lab.read()
    assert len(page.content) > 500_000
    given_up = after["accumulated_delay_s"] - before["accumulated_delay_s"]
    assert given_up < 0.1 * waited, "while it waits for the page the lab is the only one to work"
