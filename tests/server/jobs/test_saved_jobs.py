"""Jobs of a killed server are listed as interrupted; damaged files do not stop the start."""

import asyncio
import json
import os
import signal
from pathlib import Path

import pytest

from svsa.evaluation.falsifier.file import read_adversary
from svsa.evaluation.studies.file import read_study
from svsa.evaluation.studies.stored import StoredStudy
from svsa.runs.definition.design_file import load_prototype
from svsa_server.jobs import falsifications, gradings, submissions, tunings
from svsa_server.jobs.job import Job
from svsa_server.jobs.progress import PROGRESS, JobFolder
from svsa_server.jobs.queue import MAX_KEPT, Jobs
from svsa_server.jobs.saved import FILE, JobFolders
from svsa_server.schemas.evaluation.job import describe_job
from tests.lab import run_lab
from tests.server.jobs.test_jobs import count
from tests.waiting import follow

TASKS = {
    "tuning": tunings.Task("fl_integral", 30, 7, {}, load_prototype()),
    "falsification": falsifications.Task(read_adversary("impulse"), 2000, 3),
    "study": StoredStudy("mine", read_study("load")[1], Path("studies/mine"), "2026", "1"),
    "submission": submissions.Task(Path("board"), "Nothing", b"def law(*_): return 0.0, 0.0"),
    "grading": gradings.Task((), {}, Path("runs"), Path("book"), False),
}


def save(path: Path, kind: str, status: str = "running") -> Job:
    """Write a job as a server that was killed leaves it."""
    folder = path / f"{kind}-{status}"
    folder.mkdir(parents=True)
    job = Job(kind, f"A {kind}", TASKS[kind], folder, "p-1")  # pyright: ignore[reportArgumentType]
    job.status = status  # pyright: ignore[reportAttributeAccessIssue]
    job.save()
    return job


def restart(path: Path) -> dict[str, Job]:
    """List the jobs of a server that starts in this folder."""
    jobs = Jobs(dict.fromkeys(TASKS, 2), path=path)  # pyright: ignore[reportArgumentType]
    jobs.close()
    return {job.id: job for job in jobs.list_all()}


@pytest.mark.parametrize("kind", TASKS)
@pytest.mark.parametrize("status", ["waiting", "running"])
def test_job_of_a_killed_server_is_listed_as_interrupted(
    tmp_path: Path, kind: str, status: str
) -> None:
    before = save(tmp_path, kind, status)
    if status == "running":
        JobFolder(before.folder).report(12, 30)
    for _ in range(2):
        (job,) = restart(tmp_path).values()
        state = describe_job(job)
        assert (state.id, state.kind, state.title) == (before.id, kind, before.title)
        assert (job.owner, state.created) == ("p-1", before.created)
        assert state.status == "interrupted"
        assert not job.is_under_way
        where = "after 12 of 30" if status == "running" else "before it had results"
        assert (state.problem or "").startswith(f"The server ended {where}; ")
        assert "again" in (state.problem or "")
        if kind not in ("submission", "grading"):
            assert job.task == before.task
            assert (state.result is None) is (kind == "study")


@pytest.mark.parametrize("status", ["done", "failed", "cancelled"])
def test_ended_job_keeps_its_status(tmp_path: Path, status: str) -> None:
    save(tmp_path, "tuning", status)
    (job,) = restart(tmp_path).values()
    assert job.status == status


def test_cancelled_job_that_waited_is_not_interrupted(tmp_path: Path) -> None:
    save(tmp_path, "tuning", "waiting").cancel()
    (job,) = restart(tmp_path).values()
    assert job.status == "cancelled"


def test_damaged_files_do_not_stop_the_start(tmp_path: Path) -> None:
    whole = save(tmp_path, "study")
    text = (whole.folder / FILE).read_bytes()
    deep = b"[" * 5000
    wrong = [json.loads(text) | {"kind": kind} for kind in ("tuning", "nothing", None, ["x"])]
    damaged = [b"", text[:1], text[:-1], b"\x00" * 100, b"\xff\xfe", b"null", b"[]", b"{}", deep]
    damaged += [json.dumps(fields).encode() for fields in wrong]
    for number, content in enumerate(damaged):
        folder = tmp_path / f"damaged-{number}"
        folder.mkdir()
        (folder / FILE).write_bytes(content)
    (tmp_path / "directory" / FILE).mkdir(parents=True)
    (tmp_path / "pipe").mkdir()
    os.mkfifo(tmp_path / "pipe" / FILE)
    (tmp_path / "begun").mkdir()
    (tmp_path / "file").write_text("no folder")
    for content in (b"", b"{}", b"[1, 2]", b'["x", 2, 3]', b"\xff"):
        (whole.folder / PROGRESS).write_bytes(content)
        (job,) = restart(tmp_path).values()
        assert (job.id, describe_job(job).done) == (whole.id, 0)
    assert not (tmp_path / "begun").exists()


def test_damaged_result_is_reported_and_the_job_listed(tmp_path: Path) -> None:
    for kind, name in (("tuning", "candidates.jsonl"), ("falsification", "worst.toml")):
        (save(tmp_path, kind).folder / name).write_bytes(b"{\xff\n" * 3)
    for job in restart(tmp_path).values():
        state = describe_job(job)
        assert (state.status, state.result) == ("interrupted", None)
        assert "Its result is damaged" in (state.problem or "")


def test_old_jobs_are_removed_and_a_second_server_leaves_the_folder(tmp_path: Path) -> None:
    path = tmp_path / "jobs"
    for number in range(MAX_KEPT + 2):
        save(path, "study").folder.rename(path / f"{number:02}")
    kept = restart(path)
    assert len(kept) == len([*path.glob(f"*/{FILE}")]) == MAX_KEPT
    first = JobFolders(path)
    assert (first.path, JobFolders(path).saved) == (path, [])
    first.close()
    (tmp_path / "unusable").write_text("")
    assert JobFolders(tmp_path / "unusable").saved == []


@pytest.mark.parametrize("status", ["interrupted", "done"])
def test_same_search_of_a_user_continues_unless_it_was_completed(
    tmp_path: Path, status: str
) -> None:
    (save(tmp_path, "tuning", status).folder / "trials.jsonl").write_text("0\n")
    same = TASKS["tuning"]
    tasks = ((same, "p-1"), (same, "p-2"), (same._replace(seed=8), "p-1"))

    async def start() -> list[bool]:
        jobs = Jobs({"tuning": 4}, path=tmp_path)
        begun = [jobs.start("tuning", "Again", count, task, owner) for task, owner in tasks]
        jobs.drop()
        jobs.close()
        return [(job.folder / "trials.jsonl").exists() for job in begun]

    assert asyncio.run(start()) == [status == "interrupted", False, False]


@pytest.mark.exhaustive
@pytest.mark.long
def test_jobs_are_listed_and_continued_after_the_server_was_killed() -> None:
    with run_lab() as lab:
        assert lab.process is not None
        long_study = {"source": "load", "runs": 20_000}
        lab.client.post("/api/v1/studies", json=long_study).raise_for_status()
        follow(lab.client, "/api/v1/studies/load", lambda study: study["done"] >= 256)
        for path, body in (
            ("jobs", {"kind": "tuning", "law": "pd", "budget": 500}),
            ("jobs", {"kind": "falsification", "adversary": "impulse"}),
            ("leaderboard/laws", None),
        ):
            lab.client.post(f"/api/v1/{path}", json=body).raise_for_status()
        before = lab.client.get("/api/v1/jobs").json()["jobs"]
        os.kill(lab.process.pid, signal.SIGKILL)
        lab.process.wait()
        with run_lab(data=str(lab.data)) as again:
            after = again.client.get("/api/v1/jobs").raise_for_status().json()["jobs"]
            assert [(job["id"], job["title"]) for job in after] == [
                (job["id"], job["title"]) for job in before
            ]
            assert {job["status"] for job in after} == {"interrupted"}
            study = again.client.get("/api/v1/studies/load").raise_for_status().json()
            assert (study["done"] >= 256, study["job"]["status"]) == (True, "interrupted")
            again.client.post("/api/v1/studies", json=long_study).raise_for_status()
            follow(again.client, "/api/v1/studies/load", lambda now: now["done"] > study["done"])
            for job in again.client.get("/api/v1/jobs").json()["jobs"]:
                again.client.delete(f"/api/v1/jobs/{job['id']}").raise_for_status()
