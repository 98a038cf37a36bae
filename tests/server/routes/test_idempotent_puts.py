"""A repeated PUT has no effect: the same samples, record and events."""

from collections.abc import Iterator

import httpx
import pytest

from tests.lab_in_process import run_lab_in_process
from tests.server.routes.writing import SESSION, WRITING, list_examples, write
from tests.waiting import follow_recording

PUTS = [label for label in WRITING if label.startswith(f"PUT {SESSION}")]
ONLY_IN_A_CLASS = [f"PUT {SESSION}/control/lock"]
MOTION = {"kind": "minimum_jerk", "duration_s": 0.5, "transition_s": 0.5}
REPEATED = {
    "position": MOTION | {"start_rad": 0.1, "end_rad": 0.2},
    "stiffness": MOTION | {"start_nm_per_rad": 15.0, "end_nm_per_rad": 18.0},
}


@pytest.fixture(scope="module")
def lab() -> Iterator[httpx.Client]:
    with run_lab_in_process() as lab:
        lab.client.headers["SVSA-Client"] = "twice"
        yield lab.client


def open_session(lab: httpx.Client) -> str:
    """The path of a private session, paused, with two lanes."""
    asked = {"comparisons": [{"law": "pd"}], "load": False}
    name = lab.post("/api/v1/sessions", json=asked).raise_for_status().json()["session"]
    path = f"/api/v1/sessions/{name}"
    lab.post(path + "/pause").raise_for_status()
    lab.post(path + "/reset").raise_for_status()
    return path


def step(lab: httpx.Client, path: str, ticks: int) -> dict:
    return lab.post(path + "/step", json={"ticks": ticks}).raise_for_status().json()


def read_commands(lab: httpx.Client, path: str) -> list[dict]:
    return lab.get(path + "/origin").raise_for_status().json()["commands"]


def read_kept(state: dict) -> dict:
    """Return the stored data of a session, without its computing time."""
    kept = ("configuration", "loads", "events", "window", "ended_windows", "revision", "control")
    return {name: state[name] for name in (*kept, "tick", "run_number", "status", "sample")}


@pytest.fixture(params=[label for label in PUTS if label not in ONLY_IN_A_CLASS])
def label(request: pytest.FixtureRequest) -> str:
    return request.param


def test_repeated_put_changes_neither_samples_nor_record_nor_events(
    lab: httpx.Client, label: str
) -> None:
    once, twice = open_session(lab), open_session(lab)
    for path in (once, twice):
        step(lab, path, 50)
        write(lab, path, label).raise_for_status()
        step(lab, path, 100)
    before, commands = lab.get(twice).json(), read_commands(lab, twice)
    recording = lab.post(twice + "/recording", json={"name": "twice"}).raise_for_status().json()
    run = f"/api/v1/runs/{recording['recording']['run_id']}"
    answer = write(lab, twice, label).raise_for_status().json()
    assert read_kept(answer) == read_kept(before)
    assert read_commands(lab, twice) == commands
    states = [step(lab, path, 400) for path in (once, twice)]
    assert states[0]["sample"] == states[1]["sample"]
    assert states[0]["window"] == states[1]["window"]
    lab.delete(twice + "/recording").raise_for_status()
    follow_recording(lab, run)
    assert read_commands(lab, run) == commands
    for path in (once, twice):
        lab.delete(path).raise_for_status()


def test_every_put_of_a_session_has_an_example_to_repeat() -> None:
    assert len(PUTS) >= 12
    assert all(list_examples(WRITING[label]) for label in PUTS)


@pytest.mark.parametrize("name", REPEATED)
def test_reference_restarts_on_request(lab: httpx.Client, name: str) -> None:
    path = open_session(lab)
    unit = "rad" if name == "position" else "nm_per_rad"
    reference = f"{name}_reference_{unit}"
    lab.put(f"{path}/{name}", json=REPEATED[name]).raise_for_status()
    ended = step(lab, path, 1100)
    again = (
        lab.put(f"{path}/{name}", json=REPEATED[name], params={"restart": True})
        .raise_for_status()
        .json()
    )
    assert again["configuration"] == ended["configuration"]
    assert (again["events"][-1]["kind"], again["window"]["start_tick"]) == (name, 1100)
    assert [one["command"]["kind"] for one in read_commands(lab, path)] == [name, name]
    begun = step(lab, path, 501)["sample"][reference]
    assert begun == pytest.approx(REPEATED[name][f"start_{unit}"])
    assert step(lab, path, 599)["sample"][reference] == ended["sample"][reference] > begun
    lab.delete(path).raise_for_status()
