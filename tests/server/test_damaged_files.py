"""Damaged files in the data folder: the lab starts, and loses only what is damaged."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from svsa.evaluation.falsifier.file import keep_scenario
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa.evaluation.studies.file import read_study
from svsa.evaluation.studies.store import keep_study
from svsa.teaching.class_folder import keep_secret
from svsa_server.access.class_keys import ClassKeys
from tests.exhaustive import exhaust
from tests.lab_in_process import run_lab_in_process
from tests.server.access.classroom import SHARED, Classroom, run_class
from tests.server.jobs.test_saved_jobs import save
from tests.server.routes.test_scenarios_routes import IMPULSE
from tests.waiting import follow_recording, wait_until

DAMAGED = (
    "audit.jsonl", "audit.jsonl.1", "catalogue.sqlite", "course/people/instructor.json",
    "course/people/instructor.previous", "jobs/tuning-failed/job.json",
    "jobs/tuning-done/candidates.jsonl", "jobs/tuning-done/progress.json",
    "leaderboard/entries/ndobc.json", "scenarios/a.toml", "studies/a/study.json",
    "runs/{run}/header.json", "runs/{run}/commands.jsonl", "runs/{run}/samples.parquet",
)  # fmt: skip
"""One file of each kind; another one of the same kind is whole."""


def become(make: Callable[[Path], object]) -> Callable[[Path, bytes], object]:
    return lambda path, _: (path.unlink(), make(path))


def flip(path: Path, content: bytes) -> None:
    place = len(content) * 2 // 3
    content = content or b"x"
    path.write_bytes(content[:place] + bytes([content[place] ^ 4]) + content[place + 1 :])


DAMAGES: dict[str, Callable[[Path, bytes], object]] = {
    "empty": lambda path, _: path.write_bytes(b""),
    "cut": lambda path, content: path.write_bytes(content[: len(content) // 2]),
    "one bit": flip,
    "random": lambda path, _: path.write_bytes(np.random.default_rng(1).bytes(5000)),
    "deep lists": lambda path, _: path.write_bytes(b"[" * 100_000 + b"\n"),
    "deep objects": lambda path, _: path.write_bytes(b'{"a":' * 100_000 + b"\n"),
    "another value": lambda path, _: path.write_bytes(b'["a", 1e999, {}]\n'),
    "folder": become(lambda path: (path / "x").mkdir(parents=True)),
    "circle": become(lambda path: path.symlink_to(path.name)),
}


@pytest.fixture(scope="module")
def filled(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str, list[str]]:
    """A data folder, the instructor's token, and the runs."""
    folder, runs = tmp_path_factory.mktemp("filled"), []
    with run_class(folder) as classroom:
        browser = classroom.log_in()
        name = browser.get("/api/v1/course").json()["exercises"][0]["name"]
        for step in browser.get(f"/api/v1/course/{name}").json()["parts"][:2]:
            path = f"/api/v1/course/{name}/place"
            browser.put(path, json={"step": step["name"]}).raise_for_status()
        for _ in range(2):
            answer = browser.post(f"{SHARED}/recording", json={}).raise_for_status()
            runs.append(answer.json()["recording"]["run_id"])
            browser.post(f"{SHARED}/pause").raise_for_status()
            browser.put(f"{SHARED}/speed", json={"speed": 1}).raise_for_status()
            browser.post(f"{SHARED}/step", json={"ticks": 200}).raise_for_status()
            browser.delete(f"{SHARED}/recording").raise_for_status()
            follow_recording(browser, f"/api/v1/runs/{runs[-1]}")
        token = classroom.reported.instructor_token
        for name in "ab":
            keep_scenario(name, LoadScenario(**IMPULSE))
            keep_study(name, read_study("load")[1])
    for status in ("failed", "done"):
        save(folder / "jobs", "tuning", status)
    (folder / "leaderboard" / "entries").mkdir(parents=True)
    keep_secret(folder / "leaderboard" / "secret")
    for path in DAMAGED:
        place = folder / path.replace("{run}", runs[0])
        if not place.exists():
            place.write_bytes(json.dumps([path, "more"]).encode())
    return folder, token, runs


@pytest.mark.parametrize("damage", exhaust(DAMAGES, ["random", "deep lists"]))
def test_only_what_is_damaged_is_lost(
    filled: tuple[Path, str, list[str]],
    tmp_path: Path,
    damage: str,
    capsys: pytest.CaptureFixture[str],
    caplog: pytest.LogCaptureFixture,
) -> None:
    source, token, runs = filled
    folder = Path(shutil.copytree(source, tmp_path / "data"))
    for path in DAMAGED:
        place = folder / path.replace("{run}", runs[0])
        DAMAGES[damage](place, place.read_bytes())
    with run_lab_in_process(data=str(folder), classroom="1") as lab:
        keys, _ = ClassKeys.open(folder)
        assert keys.is_instructor(token)
        browser = Classroom(lab, None).open_browser(token)  # pyright: ignore[reportArgumentType]

        def read(path: str) -> dict:
            answer = browser.get(f"/api/v1/{path}")
            assert answer.status_code < 500, (path, answer.text)
            assert str(folder) not in answer.text
            return answer.json()

        wait_until(lambda: read("runs")["indexing"] is None)
        assert runs[1] in [run["id"] for run in read("runs")["runs"]]
        assert "b" in [scenario["name"] for scenario in read("scenarios")]
        assert "b" in [study["name"] for study in read("studies")["saved"]]
        assert "tuning-done" in [job["id"] for job in read("jobs")["jobs"]]
        assert "ndobc" in read("leaderboard")["missing"]
        for path in ("course", "grades", "audit", "class/people", f"runs/{runs[0]}",
                     f"runs/{runs[0]}/samples", "scenarios/a", "studies/a"):  # fmt: skip
            read(path)
        for path in (f"runs/{runs[0]}/verify", f"runs/{runs[1]}/verify"):
            assert browser.post(f"/api/v1/{path}").status_code < 500
    assert not [record for record in caplog.records if record.exc_info]
    assert "Traceback" not in capsys.readouterr().err
