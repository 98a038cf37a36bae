"""An archive of the data folder, created during a recording, and its restored content."""

import sqlite3
import tarfile
from pathlib import Path

import httpx
import pytest

from svsa.errors import StateError
from svsa.runs.records.backup import MANIFEST, BackupError, back_up, restore
from tests.lab_in_process import run_lab_in_process
from tests.server.routes.test_scenarios_routes import IMPULSE
from tests.waiting import wait_until


def list_runs(lab: httpx.Client) -> dict[str, str]:
    answer = lab.get("/api/v1/runs").raise_for_status().json()
    return {run["name"]: run["state"] for run in answer["runs"]}


def test_backup_during_a_recording_is_complete(tmp_path: Path) -> None:
    data, archive, again = tmp_path / "data", tmp_path / "lab.tar.gz", tmp_path / "again"
    with run_lab_in_process(data=str(data)) as running:
        lab = running.client
        lab.put("/api/v1/scenarios/mine", json=IMPULSE).raise_for_status()
        for name in ("finished", "running"):
            lab.post("/api/v1/sessions/lab/recording", json={"name": name}).raise_for_status()
            wait_until(lambda: lab.get("/api/v1/sessions/lab").json()["recording"]["ticks"] > 500)
            if name == "finished":
                lab.delete("/api/v1/sessions/lab/recording").raise_for_status()
                wait_until(lambda: list_runs(lab)["finished"] == "complete")
        number = back_up(data, archive)
        files = {path for path in data.rglob("*") if path.is_file()}
    assert archive.stat().st_mode & 0o077 == 0
    restore(archive, again)
    assert number == sum(path.is_file() for path in again.rglob("*"))
    with run_lab_in_process(data=str(again)) as running:
        # The interrupted recording is completed in the background after the start.
        wait_until(lambda: list_runs(running.client).get("running", "recording") != "recording")
        assert list_runs(running.client)["finished"] == "complete"
        cut = next(
            run
            for run in running.client.get("/api/v1/runs").json()["runs"]
            if run["name"] == "running"
        )
        assert cut["state"] == "failed", "it was cut off, and says so"
        assert cut["duration_s"] > 0.2
        assert running.client.get("/api/v1/scenarios/mine").is_success
    assert len(files) >= number


def test_database_is_copied_with_its_write_ahead_log(tmp_path: Path) -> None:
    data = tmp_path / "data"
    data.mkdir()
    live = sqlite3.connect(data / "members.sqlite")
    live.execute("PRAGMA journal_mode = WAL")
    live.execute("CREATE TABLE member (name TEXT)")
    live.execute("INSERT INTO member VALUES ('Ada')")
    live.commit()
    back_up(data, tmp_path / "a.tar.gz")
    live.close()
    restore(tmp_path / "a.tar.gz", tmp_path / "again")
    names = [path.name for path in (tmp_path / "again").iterdir()]
    assert names == ["members.sqlite"]
    copy = sqlite3.connect(tmp_path / "again" / "members.sqlite")
    assert copy.execute("SELECT name FROM member").fetchall() == [("Ada",)]
    copy.close()


def test_restore_overwrites_nothing(tmp_path: Path) -> None:
    data = tmp_path / "data"
    data.mkdir()
    (data / "a.json").write_text("{}")
    with pytest.raises(BackupError, match="inside the data folder"):
        back_up(data, data / "a.tar.gz")
    archive = tmp_path / "a.tar.gz"
    back_up(data, archive)
    with pytest.raises(BackupError, match="exists"):
        back_up(data, archive)
    with pytest.raises(StateError, match="not empty"):
        restore(archive, data)
    with pytest.raises(BackupError, match="no data folder"):
        back_up(tmp_path / "none", tmp_path / "b.tar.gz")


@pytest.mark.parametrize("content", [b"", b"no archive", b"\x1f\x8b\x08"])
def test_other_file_is_rejected(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "a.tar.gz").write_bytes(content)
    with pytest.raises(BackupError, match=r"a\.tar\.gz"):
        restore(tmp_path / "a.tar.gz", tmp_path / "again")


def test_archive_cannot_write_outside_the_folder(tmp_path: Path) -> None:
    data, archive = tmp_path / "data", tmp_path / "a.tar.gz"
    data.mkdir()
    back_up(data, archive)
    with tarfile.open(archive) as tar:
        manifest = tar.extractfile(MANIFEST).read()
    bad = tmp_path / "bad.tar.gz"
    with tarfile.open(bad, "w:gz") as tar:
        for name in (MANIFEST, "../outside"):
            path = tmp_path / "content"
            path.write_bytes(manifest)
            tar.add(path, name)
    with pytest.raises(BackupError):
        restore(bad, tmp_path / "again")
    assert not (tmp_path / "outside").exists()
