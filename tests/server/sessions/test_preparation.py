"""A change whose code is not loaded yet: sessions continue, and its conditions still hold."""

import contextlib
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor

import httpx
import pytest

from svsa_server.sessions import preparation
from tests.lab import Lab
from tests.lab_in_process import run_lab_in_process
from tests.waiting import PATIENCE_S

LOADS_NOTHING = """
from svsa.actuators.faults import FAULT_CODES
from svsa.numerics.code_cache import SharedCache
from svsa.runs.execution.arm_run import build_run
from svsa.runs.definition.command import Set
from svsa.runs.definition.configuration import Lane
from svsa.runs.execution.fault import build_fault
from svsa.runs.session.simulated import SimulatedSession
from svsa.simulation.plant.effects import Effects
from svsa_server.schemas.lab.opening import FromActuator, FromArm
from svsa_server.sessions.preparation import rehearse

loaded = []
load = SharedCache.load_overload
SharedCache.load_overload = lambda self, *names: loaded.append(self._name) or load(self, *names)
effects = Effects.model_validate({"encoders": {}, "estimation": {}, "delay_samples": 1})
arm = FromArm.model_validate({"from": "arm", "arm": "rods", "actuators": ["svsa", "qbmove"]})
for configuration, commands in (
    (FromActuator.model_validate({"from": "actuator", "actuator": "qbmove"}).build_configuration(),
     [Set("law", "adrc"), Set("comparisons", (Lane(law="lqi"),)), Set("effects", effects)]),
    (arm.build_configuration(), [Set("law", "fl", joint=2), Set("effects", effects, joint=1)]),
):
    rehearse(configuration, commands)
    assert loaded, "this process had no code"
    loaded.clear()
    session = SimulatedSession("lab", configuration)
    session.step(10)
    for command in commands:
        session.change(command)
        session.step(10)
    for code in FAULT_CODES:
        for lane, blocks in enumerate(session.run.blocks):
            build_fault(code, lane, 10, blocks, session.run.lanes[lane].x)
    assert not loaded, loaded
"""


@pytest.mark.exhaustive
def test_prepared_change_loads_no_code() -> None:
    ran = subprocess.run(
        [sys.executable, "-c", LOADS_NOTHING], capture_output=True, text=True, check=False
    )
    assert ran.returncode == 0, ran.stderr


@pytest.fixture(scope="module")
def lab() -> Iterator[Lab]:
    with run_lab_in_process() as lab:
        yield lab


@contextlib.contextmanager
def prepared_slowly(monkeypatch: pytest.MonkeyPatch) -> Iterator[threading.Event]:
    """Delay preparations until the end of the context; set once one has begun."""
    begun, may_end, rehearse = threading.Event(), threading.Event(), preparation.rehearse

    def rehearse_late(*arguments: object) -> None:
        begun.set()
        may_end.wait(PATIENCE_S)
        rehearse(*arguments)  # pyright: ignore[reportArgumentType]

    preparation._prepared.clear()
    monkeypatch.setattr(preparation, "rehearse", rehearse_late)
    try:
        yield begun
    finally:
        may_end.set()


def change_position(lab: Lab, path: str) -> httpx.Response:
    return lab.client.put(path + "/position", json={"kind": "constant", "position_rad": 0.1})


def take_control(lab: Lab, path: str) -> httpx.Response:
    return lab.client.put(path + "/control", json={"by": "B"}, headers={"SVSA-Client": "b"})


def end_session(lab: Lab, path: str) -> httpx.Response:
    return lab.client.delete(path)


@pytest.mark.parametrize(
    ("meanwhile", "if_match", "status"),
    [
        (change_position, False, 200),
        (change_position, True, 412),
        (take_control, False, 409),
        (end_session, False, 404),
    ],
)
def test_sessions_continue_while_a_change_is_prepared_whose_conditions_are_checked_again(
    lab: Lab,
    monkeypatch: pytest.MonkeyPatch,
    meanwhile: Callable[[Lab, str], httpx.Response],
    if_match: bool,
    status: int,
) -> None:
    opened = lab.client.post("/api/v1/sessions", json={}).raise_for_status().json()
    path = f"/api/v1/sessions/{opened['session']}"
    headers = {"If-Match": opened["revision"]} if if_match else {}
    with ThreadPoolExecutor() as pool:
        with prepared_slowly(monkeypatch) as begun:
            change = pool.submit(
                lab.client.put, path + "/law", json={"law": "pid"}, headers=headers
            )
            assert begun.wait(PATIENCE_S)
            before = lab.client.get(path).json()
            assert before["configuration"]["law"] == "ndobc"
            assert meanwhile(lab, path).is_success
        answer = change.result(PATIENCE_S)
    assert answer.status_code == status, answer.text
    after = lab.client.get(path)
    if status == 200:
        held = after.json()["configuration"]
        assert (held["law"], held["position"]["position_rad"]) == ("pid", 0.1)
    elif status != 404:
        assert after.json()["configuration"]["law"] == "ndobc"


@pytest.mark.parametrize(
    ("method", "path", "body"),
    [
        ("PUT", "/law", {"law": "lqi"}),
        ("PUT", "/lanes", {"comparisons": [{"law": "esp"}]}),
        ("PUT", "/effects", {"encoders": {}}),
        ("POST", "/reset", None),
        ("POST", "/experiment", {"figure": "4b", "law": "fl"}),
    ],
)  # fmt: skip
def test_every_change_that_may_need_code_is_prepared(
    lab: Lab, monkeypatch: pytest.MonkeyPatch, method: str, path: str, body: dict | None
) -> None:
    with ThreadPoolExecutor() as pool:
        with prepared_slowly(monkeypatch) as begun:
            change = pool.submit(lab.client.request, method, lab.session + path, json=body)
            assert begun.wait(PATIENCE_S)
            assert lab.read()["status"] in ("running", "paused")
        assert change.result(PATIENCE_S).is_success
