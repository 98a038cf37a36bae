"""An exercise on a bench, from its set-up to its grade, and its rejections."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from svsa.runs.records.bench_start import START_FILE
from svsa.teaching.course.file import read_course
from svsa.teaching.grading.grade import Grade, grade
from svsa.teaching.submission import read_submission
from tests.hardware.live_bench import start_live_emulator, write_bench
from tests.lab import run_lab
from tests.server.sessions.bench_lab import BenchLab
from tests.waiting import wait_until

pytestmark = pytest.mark.wall_clock

COURSE = "/api/v1/course/held"
SLOWER = [40.0, 40.0, 40.0]
EXERCISE = """+++
number = 90
title = "Held"
goal = "See it held."

[[steps]]
name = "hold"
kind = "experiment"
title = "Hold it"
law = "ndobc"
duration_s = 1.5

[steps.base]
figure = "4a"
effects = "rig"
position = { kind = "constant", position_rad = 0.1 }
"observer.bandwidth_rad_per_s" = 40.0

[steps.bench]
by_hand = "hang 1.5 kg on the cable"
loads = [{ kind = "constant", start_s = 0.8, torque_nm = [1.0, 0.0, 0.0] }]

[[steps.measures]]
name = "error"
label = "Error at the end"
channel = "position_error_rad"
statistic = "rms"
from_s = 1.4
to_s = 1.5
unit = "°"

[[steps.criteria]]
title = "It is held"
measure = "error"
high = 2.0

[[steps]]
name = "ideal"
kind = "experiment"
title = "Ideally"
duration_s = 1.0

[[steps.measures]]
name = "error"
label = "Error"
channel = "position_error_rad"

[[steps]]
name = "end"
kind = "submit"
title = "Submit"
+++

## hold

Hold it.

## ideal

Simulated only.

## end

That is all.
"""


class Room(NamedTuple):
    bench: BenchLab
    folder: Path

    def set_up(self, step: str) -> Any:
        wanted = {"exercise": "held", "step": step}
        return self.bench.lab.client.post(
            self.bench.lab.session + "/experiment", json={"from": "exercise"} | wanted
        )

    def call(self, method: str, path: str, body: Any = None) -> Any:
        answer = self.bench.lab.client.request(method, COURSE + path, json=body)
        assert answer.is_success, answer.text
        return answer.json()

    def run(self) -> str:
        """Record from a start to the end of the step's time, as the page does."""
        bench = self.bench
        run_id = bench.ask("/recording", {"name": "held/hold"})["recording"]["run_id"]
        bench.ask("/start")
        wait_until(lambda: bench.read()["tick"] >= 1500, bench.describe)
        bench.ask("/recording", method="DELETE")
        bench.ask("/pause")
        bench.wait_for("ready")
        run = f"/api/v1/runs/{run_id}"
        wait_until(lambda: bench.lab.client.get(run).json()["state"] != "recording")
        return run_id


@pytest.fixture(scope="module")
def room(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Room]:
    folder: Path = tmp_path_factory.mktemp("course")
    course = folder / "own"
    course.mkdir()
    (course / "held.md").write_text(EXERCISE, encoding="utf-8")
    with start_live_emulator() as emulator:
        path = write_bench(folder, emulator)
        with run_lab("--bench", str(path), "--course", str(course), data=str(folder)) as lab:
            yield Room(BenchLab(lab, emulator), folder)


def test_simulated_step_is_rejected(room: Room) -> None:
    refused = room.set_up("ideal")
    assert refused.status_code == 409
    assert "can only be simulated" in refused.json()["detail"]


def test_set_up_sets_law_references_and_observer_and_keeps_the_bench(room: Room) -> None:
    before = room.bench.read()["configuration"]
    state = room.set_up("hold").raise_for_status().json()
    reported = state["configuration"]
    assert reported["position"]["position_rad"] == 0.1
    assert reported["observer"]["bandwidth_rad_per_s"] == SLOWER
    assert [load["start_s"] for load in state["loads"]] == [0.8]
    for name in ("actuator", "nominal", "limits", "effects"):
        assert reported[name] == before[name]
    step = room.call("GET", "")["parts"][0]
    assert step["bench"]["manual_loads"] == [{"time_s": 0.8, "is_on": True}]


def test_earlier_settings_are_restored_and_the_bench_stays_at_rest(room: Room) -> None:
    room.set_up("hold").raise_for_status()
    restored = room.bench.ask("/experiment", {"from": "before_exercise"})
    assert restored["configuration"]["observer"]["bandwidth_rad_per_s"] != SLOWER
    assert restored["loads"] == []
    assert restored["status"] != "running"
    assert restored["exercise"] is None


@pytest.fixture(scope="module")
def run_id(room: Room) -> Iterator[str]:
    """A run of the step, submitted."""
    room.set_up("hold").raise_for_status()
    room.bench.make_ready()
    with room.bench.watched():
        run = room.run()
    yield run


def test_reset_keeps_the_settings_and_is_rejected_in_motion(room: Room, run_id: str) -> None:
    """Gains and observer of the step are kept; the load of an emulator, which has displaced the
    link since the end of the run's torque, is removed.
    """
    reported = room.bench.ask("/reset")["configuration"]
    assert reported["observer"]["bandwidth_rad_per_s"] == SLOWER
    room.bench.make_ready()
    with room.bench.watched():
        room.bench.ask("/start")
        room.bench.wait_for("run")
        refused = room.set_up("hold")
        room.bench.ask("/pause")
        room.bench.wait_for("ready")
    assert refused.status_code == 409
    assert "The bench is moving" in refused.json()["detail"]


def grade_run(room: Room, run_id: str) -> Grade:
    reported = {"student": "Ada", "exercise": "held", "runs": {"hold": run_id}}
    path = room.folder / "submission.json"
    path.write_text(json.dumps(reported), encoding="utf-8")
    exercise = next(one for one in read_course(room.folder / "own") if one.name == "held")
    return grade(read_submission(path), exercise, room.folder, None)


def test_run_is_assessed_and_graded_by_verified_samples(room: Room, run_id: str) -> None:
    (judged,) = room.call("POST", "/steps/hold/check", {"run_id": run_id})
    assert judged["points"] == 1.0, judged["feedback"]
    given = grade_run(room, run_id)
    assert given.points == 1.0
    (found,) = given.runs
    assert found.run_id == run_id
    assert found.description.startswith("Recorded on an emulator, which cannot be run again.")
    assert "the same, bit for bit" in found.description


def test_manipulated_record_is_rejected(room: Room, run_id: str) -> None:
    path = room.folder / "runs" / run_id / START_FILE
    kept = path.read_bytes()
    start = json.loads(kept)
    start["motion"]["known"][0] += 1e-6
    path.write_text(json.dumps(start), encoding="utf-8")
    try:
        given = grade_run(room, run_id)
    finally:
        path.write_bytes(kept)
    assert given.points == 0.0
    assert given.runs == ()
    assert "does not follow from what it measured and sent" in given.criteria[0].feedback
