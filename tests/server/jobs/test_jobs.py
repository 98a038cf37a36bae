"""Long work: followed, cancelled, limited, at low priority, ended with the server."""

import asyncio
import contextlib
import os
import signal
import subprocess
import sys
import time

import pytest

from svsa.errors import ParameterError, Violation
from svsa_server.access.roles import INSTRUCTOR
from svsa_server.jobs import job as job_module
from svsa_server.jobs.heavy_work import BusyError
from svsa_server.jobs.progress import PERIOD_S, JobFolder, read_progress
from svsa_server.jobs.queue import Jobs
from svsa_server.jobs.turns import Share
from svsa_server.problems import TooManyError, UnknownError
from svsa_server.schemas.evaluation.job import describe_job

LONGEST_S = 240.0
ORPHAN = """
import asyncio, sys
from svsa_server.jobs.queue import Jobs
from tests.server.jobs.test_jobs import count

async def main():
    jobs = Jobs({"study": 1})
    job = jobs.start("study", "long", count, 10**6)
    while job.is_under_way and not job.progress.done:
        await asyncio.sleep(0.05)
    print((job.folder / "process").read_text(), flush=True)
    await asyncio.sleep(300)

if __name__ == "__main__":
    asyncio.run(main())
"""


def count(folder: JobFolder, total: int) -> bool:
    """Run a step of a fiftieth of a second until the end or cancellation."""
    (folder.path / "process").write_text(f"{os.getpid()} {os.nice(0)}")
    for done in range(1, total + 1):
        time.sleep(0.02)
        folder.report(done, total)
        if folder.is_cancelled():
            return False
    return True


def count_and_wait(folder: JobFolder, total: int) -> bool:
    """As `count`, but end only after the test has created the file `end`."""
    counted = count(folder, total)
    while not (folder.path / "end").exists():
        time.sleep(0.02)
    return counted


def refuse(folder: JobFolder, name: str) -> bool:
    raise ParameterError(Violation(name, 9.0, "Hz", "at most 5 Hz"))


def die(folder: JobFolder, code: int) -> bool:
    os._exit(code)


def err(folder: JobFolder, text: str) -> bool:
    raise ZeroDivisionError(text)


async def wait_until(is_there):
    end = time.monotonic() + LONGEST_S
    while not is_there():
        assert time.monotonic() < end
        await asyncio.sleep(0.02)


@contextlib.contextmanager
def open_jobs(studies: int, tunings: int = 0):
    jobs = Jobs({"study": studies, "tuning": tunings})
    try:
        yield jobs
    finally:
        jobs.close()


def test_job_is_followed_to_its_end_at_a_low_priority():
    async def follow(jobs):
        job = jobs.start("study", "Forty", count_and_wait, 40)
        assert (job.status, describe_job(job).total) == ("waiting", 0)
        await wait_until(lambda: job.progress.rate_per_s)
        seen = describe_job(job)
        assert (seen.status, seen.total, seen.title) == ("running", 40, "Forty")
        assert 0 < seen.done <= 40
        assert seen.left_s == pytest.approx((40 - seen.done) / (seen.rate_per_s or 0.0))
        (job.folder / "end").touch()
        await wait_until(lambda: not job.is_under_way)
        ended = describe_job(job)
        assert (ended.status, ended.done, ended.left_s, ended.problem) == ("done", 40, None, None)
        process, niceness = map(int, (job.folder / "process").read_text().split())
        assert process != os.getpid()
        assert niceness == 10

    with open_jobs(1) as jobs:
        asyncio.run(follow(jobs))


def test_jobs_of_a_kind_run_one_at_a_time_and_a_full_queue_is_rejected():
    async def crowd(jobs):
        first, second = (jobs.start("study", "long", count, 10**6) for _ in range(2))
        with pytest.raises(BusyError, match="2 studies run or wait"):
            jobs.start("study", "one too many", count, 1)
        other = jobs.start("tuning", "short", count, 1)
        await wait_until(lambda: other.status == "done" and first.progress.done)
        assert (first.status, second.status) == ("running", "waiting")
        assert jobs.list_all() == [other, second, first]
        assert jobs.list_all("tuning") == [other]
        with pytest.raises(UnknownError, match="no tuning"):
            jobs.get(first.id, "tuning")

        second.cancel()
        assert second.status == "cancelled"
        third = jobs.start("study", "next", count, 2)
        first.cancel()
        await wait_until(lambda: third.status == "done")
        assert first.status == "cancelled"
        assert 0 < first.progress.done < 10**6
        assert second.progress.done == 0

    with open_jobs(2, 1) as jobs:
        asyncio.run(crowd(jobs))


def crawl(folder: JobFolder, seconds: float) -> bool:
    """Run for this time without checking for cancellation."""
    folder.report(1, 2)
    time.sleep(seconds)
    return True


def test_jobs_of_a_class_alternate_by_user_with_priority_of_the_instructor():
    async def share(jobs):
        first = jobs.start("study", "a1", count, 10**6, "a")
        second = jobs.start("study", "a2", count, 3, "a")
        with pytest.raises(TooManyError, match="2 of your studies run or wait"):
            jobs.start("study", "a3", count, 3, "a")
        other = jobs.start("study", "b1", count, 3, "b")
        with pytest.raises(BusyError, match="this lab accepts 3 at once"):
            jobs.start("study", "c1", count, 3, "c")
        own = jobs.start("study", "instructor's", count, 3, INSTRUCTOR.id)
        await wait_until(lambda: first.progress.done)
        ended = []
        first.cancel()
        while len(ended) < 4:
            await asyncio.sleep(0.01)
            ended += [job for job in jobs.list_all() if not job.is_under_way and job not in ended]
        assert ended == [first, own, other, second]

    jobs = Jobs({"study": 3}, Share(2, 600.0))
    try:
        asyncio.run(share(jobs))
    finally:
        jobs.close()


@pytest.mark.parametrize(("work", "kept"), [(count, "many"), (crawl, "one")])
def test_job_of_a_user_ends_at_its_time_limit_and_the_next_one_runs(
    monkeypatch: pytest.MonkeyPatch, work, kept: str
):
    monkeypatch.setattr(job_module, "GRACE_S", 0.5)

    async def outstay(jobs):
        # The time of a job includes the start of a worker, which takes seconds: the first job and
        # the one after the end of the worker are of the instructor, who has no limit.
        first = jobs.start("study", "first", count, 1, INSTRUCTOR.id)
        await wait_until(lambda: first.status == "done")
        job = jobs.start("study", "long", work, 10**6, "a")
        after = jobs.start("study", "next", count, 2, INSTRUCTOR.id)
        await wait_until(lambda: not job.is_under_way)
        assert job.status == "failed"
        assert "Stopped after 3 s" in job.problem
        assert (job.progress.done > 1) is (kept == "many")
        await wait_until(lambda: after.status == "done")

    jobs = Jobs({"study": 3}, Share(2, 3.0))
    try:
        asyncio.run(outstay(jobs))
    finally:
        jobs.close()


def test_failed_job_reports_why_and_the_next_one_runs():
    async def fail(jobs):
        reported = []
        for work, asked in ((refuse, "frequency_hz"), (die, 1), (err, "nothing to share by")):
            job = jobs.start("study", "wrong", work, asked)
            await wait_until(lambda job=job: not job.is_under_way)
            assert job.status == "failed"
            reported.append(job.problem)
        refused, died, erred = reported
        assert "frequency_hz is 9.0 Hz: it must be at most 5 Hz" in refused
        assert "has ended" in died
        assert erred == "nothing to share by"
        last = jobs.start("study", "right", count, 1)
        await wait_until(lambda: last.status == "done")

    with open_jobs(1) as jobs:
        asyncio.run(fail(jobs))


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL")
def test_job_ends_with_its_server_after_any_end():
    server = subprocess.Popen(
        [sys.executable, "-c", ORPHAN], stdout=subprocess.PIPE, text=True, env=os.environ
    )
    assert server.stdout is not None
    worker = int(server.stdout.readline().split()[0])
    os.kill(worker, 0)
    server.send_signal(signal.SIGKILL)
    server.wait()
    end = time.monotonic() + LONGEST_S
    with pytest.raises(ProcessLookupError):
        while time.monotonic() < end:
            os.kill(worker, 0)
            time.sleep(0.05)


def test_progress_is_written_at_intervals_and_at_the_end(tmp_path, monkeypatch):
    now = 100.0
    monkeypatch.setattr(time, "monotonic", lambda: now)
    folder = JobFolder(tmp_path)
    assert read_progress(tmp_path) == (0, 0, None)
    folder.report(0, 1000)
    assert read_progress(tmp_path) == (0, 1000, None)
    now += PERIOD_S / 2
    folder.report(5, 1000)
    assert read_progress(tmp_path).done == 0
    folder.write()
    assert read_progress(tmp_path) == (5, 1000, pytest.approx(50.0))
    for step in range(1, 41):
        now += 1.0
        folder.report(5 + 20 * step, 1000)
    progress = read_progress(tmp_path)
    assert progress.rate_per_s == pytest.approx(20.0), "of the last seconds, not of the whole"
    assert progress.left_s == pytest.approx((1000 - 805) / 20.0)
