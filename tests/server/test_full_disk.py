"""A data folder on a full or read-only disk: requests are rejected, and nothing is lost."""

import contextlib
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from svsa.teaching.class_folder import SECRET_BYTES, keep_secret
from tests.lab_in_process import run_lab_in_process
from tests.server.access.classroom import Classroom, read_kind, run_class
from tests.server.routes.test_scenarios_routes import IMPULSE
from tests.waiting import wait_until

SCENARIO = "/api/v1/scenarios/mine"


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Path]:
    with mount_disk(tmp_path) as folder:
        yield folder


@contextlib.contextmanager
def mount_disk(place: Path, size: str = "8m") -> Iterator[Path]:
    """Mount a real file system of this size."""
    folder = place / "disk"
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)]
    if not shutil.which("mount") or subprocess.run(mount, capture_output=True).returncode:
        pytest.skip("this account cannot mount a file system")
    try:
        yield folder
    finally:
        subprocess.run(["umount", "--lazy", str(folder)], check=True)


@pytest.fixture(scope="module")
def shared_disk(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Path, Classroom]]:
    """A class on a file system of its own."""
    with mount_disk(tmp_path_factory.mktemp("class")) as disk, run_class(disk) as classroom:
        yield disk, classroom


@contextlib.contextmanager
def filled(disk: Path) -> Iterator[None]:
    """Fill the disk."""
    filler = disk / "filler"
    with filler.open("wb", buffering=0) as file, contextlib.suppress(OSError):
        while file.write(b" " * 65536):
            pass
    yield
    filler.unlink()


def test_request_on_a_full_disk_is_rejected_and_succeeds_with_free_space(disk: Path) -> None:
    with run_lab_in_process(data=str(disk)) as running:
        lab = running.client
        name = lab.get("/api/v1/course").raise_for_status().json()["exercises"][0]["name"]
        exercise = lab.get(f"/api/v1/course/{name}").raise_for_status().json()
        first, second = (step["name"] for step in exercise["parts"][:2])
        path = f"/api/v1/course/{name}/place"
        lab.put(path, json={"step": first}).raise_for_status()
        with filled(disk):
            rejected = [lab.put(SCENARIO, json=IMPULSE), lab.put(path, json={"step": second})]
            for answer in rejected:
                assert (answer.status_code, read_kind(answer)) == (507, "storage")
                assert "No space left" in answer.json()["detail"]
            assert lab.get(f"/api/v1/course/{name}").json()["at"] == first
        lab.put(SCENARIO, json=IMPULSE).raise_for_status()
        lab.put(path, json={"step": second}).raise_for_status()
        assert [*disk.rglob("*.tmp"), *disk.rglob("*.part")] == []


@pytest.mark.parametrize(
    ("method", "path", "body"),
    [
        ("POST", "/sessions/lab/recording", {}),
        ("POST", "/sessions/lab/excitation", {"name": "full"}),
        ("POST", "/studies", {"source": "load", "runs": 8}),
        ("POST", "/jobs", {"kind": "tuning", "law": "fl", "budget": 1}),
        ("POST", "/jobs", {"kind": "falsification", "adversary": "impulse", "runs": 1}),
        ("POST", "/leaderboard/laws", None),
        ("POST", "/leaderboard/submissions", {"name": "A", "law": "def law(*_): return 0.0, 0.0"}),
        ("POST", "/join", None),
        ("POST", "/class/code", None),
        ("POST", "/rejoin-code", None),
    ],
)
def test_every_route_that_writes_reports_a_full_disk(
    shared_disk: tuple[Path, Classroom], method: str, path: str, body: dict | None
) -> None:
    disk, classroom = shared_disk
    lab = classroom.join("Bob") if path == "/rejoin-code" else classroom.log_in()
    if path == "/join":
        body = {"name": "Ada", "code": classroom.reported.code}
    with filled(disk):
        answer = lab.request(method, f"/api/v1{path}", json=body)
        assert (answer.status_code, read_kind(answer)) == (507, "storage"), answer.text
    assert str(disk) not in answer.text


@pytest.mark.exhaustive
def test_recording_ended_by_a_full_disk_is_listed_as_failed_with_its_readable_part(
    disk: Path,
) -> None:
    def read_run(client: httpx.Client) -> dict:
        (run,) = client.get("/api/v1/runs").raise_for_status().json()["runs"]
        return run

    with run_lab_in_process(data=str(disk)) as lab:
        lab.load_figure()
        lab.client.post(lab.session + "/recording", json={}).raise_for_status()
        lab.jump(1)
        wait_until(lambda: lab.read()["recording"]["ticks"] >= 1000)
        assert read_run(lab.client)["state"] == "recording"
        with filled(disk):
            lab.jump(2)
            wait_until(lambda: lab.read()["recording"]["state"] == "failed")
            wait_until(lambda: read_run(lab.client)["state"] == "failed")
            lab.client.delete(lab.session + "/recording").raise_for_status()
            run = read_run(lab.client)
            assert run["state"] == "failed"
            assert "No space left" in run["message"]
            assert f"The first {run['duration_s']:.6g} s were saved" in run["message"]
            assert run["duration_s"] >= 1.0
            path = f"/api/v1/runs/{run['id']}/samples"
            assert lab.client.get(path, params={"channels": "position_rad"}).is_success
    with run_lab_in_process(data=str(disk)) as lab:
        wait_until(lambda: lab.client.get("/api/v1/runs").json()["indexing"] is None)
        assert read_run(lab.client)["state"] == "failed"
        assert not [*disk.rglob("samples.arrows")]


def test_full_disk_leaves_no_empty_secret(disk: Path) -> None:
    with filled(disk), pytest.raises(OSError, match="No space left"):
        keep_secret(disk / "secret")
    assert not (disk / "secret").exists()
    assert len(keep_secret(disk / "secret")) == SECRET_BYTES


@pytest.mark.exhaustive
def test_leaderboard_on_a_read_only_disk_reports_it(disk: Path, tmp_path: Path) -> None:
    with run_lab_in_process(data=str(disk)) as running:
        # The catalogue's file stays open for writing: a second, read-only mount of the same disk,
        # made read-only aside, where no process opens a file between the two steps.
        aside = tmp_path / "read_only"
        aside.mkdir()
        subprocess.run(["mount", "--bind", str(disk), str(aside)], check=True)
        subprocess.run(["mount", "-o", "remount,bind,ro", str(aside)], check=True)
        subprocess.run(["mount", "--bind", str(aside), str(disk)], check=True)
        subprocess.run(["umount", str(aside)], check=True)
        read = running.client.get("/api/v1/leaderboard")
        answer = running.client.post("/api/v1/leaderboard/laws")
        subprocess.run(["umount", "--lazy", str(disk)], check=True)
        assert read.json()["began"] is None
        assert answer.status_code in (422, 507)
        assert "Read-only file system" in answer.json()["detail"]
