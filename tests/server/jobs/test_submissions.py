"""A law for the leaderboard over REST: rejected, followed, cancelled, and stored once."""

import pytest

from svsa.teaching.isolation.refusal import NotIsolatedError
from svsa.teaching.leaderboard.board import FOLDER, Board
from svsa.teaching.submission import digest_law
from svsa_server.jobs.progress import JobFolder, ask_to_stop, read_progress
from svsa_server.jobs.submissions import Task, measure_laws
from tests.lab_in_process import run_lab_in_process
from tests.teaching.grading.submissions import GOOD, LAZY
from tests.teaching.isolation.test_attacks import isolation  # noqa: F401
from tests.teaching.leaderboard.test_leaderboard import short_season  # noqa: F401
from tests.waiting import follow

BOARD = "/api/v1/leaderboard"


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="module")
def lab(data):
    with run_lab_in_process(data=str(data), max_submissions="2") as lab:
        yield lab.client


def test_visit_does_not_start_a_season(lab, data):
    state = lab.get(BOARD).json()
    assert state["began"] is None
    assert state["entries"] == []
    assert {"fl", "ndobc"} <= set(state["missing"])
    assert state["runs"] == 214
    assert lab.get(f"{BOARD}/entries/fl/replay").status_code == 404
    assert not (data / FOLDER).exists()


def test_failing_law_is_rejected_by_its_job_without_an_entry(lab, data):
    law = "def law(*given):\n    return spring\n"
    begun = lab.post(f"{BOARD}/submissions", json={"name": "Mine", "law": law})
    assert begun.status_code == 201
    assert begun.json()["key"] == digest_law(law.encode())
    assert lab.get(BOARD).json()["began"] is not None
    assert (data / FOLDER / "secret").stat().st_mode & 0o077 == 0
    state = follow(lab, f"/api/v1/jobs/{begun.json()['job']['id']}")
    assert state["status"] == "failed"
    assert "name 'spring' is not defined" in state["problem"]
    assert lab.get(BOARD).json()["entries"] == []


@pytest.mark.exhaustive
def test_cancelled_submission_has_no_entry(lab):
    begun = lab.post(f"{BOARD}/submissions", json={"name": "Mine", "law": LAZY.decode()}).json()
    name = begun["job"]["id"]
    state = follow(lab, f"/api/v1/jobs/{name}", lambda state: state["done"] >= 2)
    assert state["kind"] == "submission"
    assert state["title"] == "Mine"
    assert state["total"] == lab.get(BOARD).json()["runs"]
    lab.delete(f"/api/v1/jobs/{name}")
    follow(lab, f"/api/v1/jobs/{name}", lambda state: state["status"] == "cancelled")
    assert lab.get(BOARD).json()["entries"] == []


@pytest.mark.parametrize(
    ("wanted", "reported"),
    [
        ({"name": "two\nlines", "law": "pass"}, "name"),
        ({"name": "Mine", "law": ""}, "law"),
        ({"name": "Mine", "law": "ä" * 40_000}, "65536 bytes"),
    ],
)
def test_invalid_submission_is_rejected(lab, wanted, reported):
    refused = lab.post(f"{BOARD}/submissions", json=wanted)
    assert refused.status_code == 422
    assert reported in refused.text


@pytest.mark.exhaustive
@pytest.mark.usefixtures("short_season")
def test_worker_enters_the_submitted_and_installed_laws_and_repeated_text_has_no_second_job(
    lab, data, tmp_path
):
    folder = JobFolder(tmp_path)
    board = data / FOLDER
    assert measure_laws(folder, Task(board, "Mine", GOOD, "Ada"))
    folder.write()
    progress = read_progress(tmp_path)
    assert progress.done == progress.total == 3 * Board(board).season.run_count
    state = lab.get(BOARD).json()
    assert {one["name"] for one in state["entries"]} == {"Mine", "fl", "ndobc"}
    assert min(one["rank"] for one in state["entries"]) == 1
    assert state["missing"] == []
    assert state["not_isolated"] is None
    assert next(one["author"] for one in state["entries"] if one["name"] == "Mine") == "Ada"
    again = lab.post(f"{BOARD}/submissions", json={"name": "Another", "law": GOOD.decode()})
    assert again.json() == {"key": digest_law(GOOD), "job": None}


@pytest.mark.usefixtures("short_season")
def test_cancelled_worker_enters_nothing(tmp_path):
    ask_to_stop(tmp_path)
    assert not measure_laws(JobFolder(tmp_path), Task(tmp_path / "board", "Mine", GOOD))
    assert Board(tmp_path / "board").list() == []


def test_law_without_isolation_is_rejected_with_reason(lab, monkeypatch):
    def refuse():
        raise NotIsolatedError("bwrap is not installed")

    monkeypatch.setattr("svsa_server.routes.teaching.leaderboard.check_isolation", refuse)
    refused = lab.post(f"{BOARD}/submissions", json={"name": "Mine", "law": "pass"})
    assert refused.status_code == 409
    assert refused.json()["type"] == "urn:svsa:problem:not_isolated"
    assert "bwrap is not installed" in refused.json()["detail"]


def test_board_without_isolation_reports_it_before_a_submission(lab, monkeypatch):
    def refuse():
        raise NotIsolatedError("bwrap is not installed")

    monkeypatch.setattr("svsa.teaching.isolation.probe.check_isolation", refuse)
    assert "bwrap is not installed" in lab.get(BOARD).json()["not_isolated"]


def test_unknown_entry_has_no_replay(lab):
    refused = lab.get(f"{BOARD}/entries/none_such/replay")
    assert refused.status_code == 404
    assert "no entry none_such" in refused.json()["detail"]
