"""A class with a bench: the emulator in lockstep, driven by the real session and loop."""

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import httpx
import numpy as np
import pytest

import svsa
from svsa.client import Lab
from svsa.client.session import RemoteSession
from svsa_server.access.class_keys import ClassKeys
from svsa_server.access.memberships import FILE, Membership, Memberships
from svsa_server.access.roles import INSTRUCTOR, Person, Role
from tests.client.copied_script import (
    END_S,
    do_experiment,
    finish_script,
    start_script,
    write_copied_script,
)
from tests.exhaustive import exhaust
from tests.hardware.live_bench import start_live_emulator, write_bench
from tests.lab import run_lab
from tests.lab_in_process import run_lab_in_process
from tests.server.sessions.bench_lab import BenchLab
from tests.waiting import PATIENCE_S

pytestmark = pytest.mark.wall_clock

ADA, BOB = Person("p-1", "Ada", Role.OPERATOR), Person("p-2", "Bob", Role.OPERATOR)
RAMP_TICKS = 300
TORQUES = ("torque1_nm", "torque2_nm")


class Room(NamedTuple):
    """bench: with the instructor's token. folder: its data. tokens: of Ada, Bob, the instructor."""

    bench: BenchLab
    folder: Path
    tokens: tuple[str, str, str]

    def connect(self, number: int) -> Lab:
        """Connect a script of one of them to the lab."""
        return svsa.connect(self.bench.lab.url, self.tokens[number])


@pytest.fixture(scope="module")
def room(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Room]:
    folder: Path = tmp_path_factory.mktemp("class")
    keys, _ = ClassKeys.open(folder)
    for person in (ADA, BOB):
        Memberships(folder / FILE).keep(Membership(person))
    ada, bob, instructor = (keys.sign(one) for one in (ADA, BOB, INSTRUCTOR))
    with start_live_emulator() as emulator:
        path = write_bench(folder, emulator)
        with run_lab("--class", "--bench", str(path), data=str(folder)) as lab:
            lab.client.headers["Authorization"] = f"Bearer {instructor}"
            yield Room(BenchLab(lab, emulator), folder, (ada, bob, instructor))


def run_against_a_load(session: RemoteSession) -> None:
    """Hold the link against a load, so that the motors need torque."""
    session.position = svsa.ConstantPosition(position_rad=0.1)
    session.loads.add(svsa.ConstantLoad(torque_nm=(1.0, 0.0, 0.0)))
    session.run_until(1.0)


def hand_over(ada: Lab, instructor: Lab) -> None:
    ada.session.hand_control_over("Bob")


def give_back(ada: Lab, instructor: Lab) -> None:
    ada.session.give_control_back()


def take_over(ada: Lab, instructor: Lab) -> None:
    instructor.session.take_control(take_over=True)


def lock(ada: Lab, instructor: Lab) -> None:
    instructor.session.call("PUT", "/control/lock", {"locked": True})


def remove(ada: Lab, instructor: Lab) -> None:
    instructor.connection.call("PATCH", f"/class/people/{ADA.id}", {"removed": True})


CHANGES = [hand_over, give_back, take_over, lock, remove]


@pytest.mark.parametrize("change", exhaust(CHANGES, [hand_over]))
def test_bench_ramps_down_before_another_user_gets_it(
    room: Room, change: Callable[[Lab, Lab], None]
) -> None:
    with room.connect(0) as ada, room.connect(1) as bob, room.connect(2) as instructor:
        room.bench.make_ready()
        ada.session.take_control()
        ada.session.reset()
        with bob.session.watch():
            recording = ada.session.record(change.__name__)
            run_against_a_load(ada.session)
            bob.session.call("PUT", "/control", {"by": "Bob"})
            change(ada, instructor)
            room.bench.wait_for("ready")
            assert room.bench.is_at_zero()
            state = bob.session.read_state()
            assert state["control"]["holder"] != "Ada"
            assert state["events"][-1]["label"] == "Stop"
        instructor.session.take_control(take_over=True)
        instructor.session.call("DELETE", "/recording")
        instructor.session.reset()
        while instructor.connection.read(f"/runs/{recording.run_id}")["state"] == "recording":
            time.sleep(0.05)
        expect_ramp(svsa.open_run(room.folder / "runs" / recording.run_id))
        instructor.session.call("PUT", "/control/lock", {"locked": False})
        instructor.connection.call("PATCH", f"/class/people/{ADA.id}", {"removed": False})
        for one in (ada, bob, instructor):
            one.session.give_control_back()


def expect_ramp(result: svsa.Result) -> None:
    """The torques of a run decrease to zero in these ticks, each below its share."""
    torques = np.abs(np.column_stack([result[name] for name in TORQUES])).max(axis=1)
    torques = torques[np.isfinite(torques)]
    before, ramp = torques[-2 * RAMP_TICKS : -RAMP_TICKS], torques[-RAMP_TICKS:]
    assert before.mean() > 0.1, "the motors held the load"
    means = ramp.reshape(6, -1).mean(axis=1)
    assert means[0] > 0.3 * before.mean(), "not at once"
    assert means[-1] < 0.25 * means[0]
    assert ramp[-1] < 0.02 * before.max()


def test_new_holder_starts_the_bench_again_once_it_is_at_rest(room: Room) -> None:
    with room.connect(0) as ada, room.connect(1) as bob:
        room.bench.make_ready()
        ada.session.take_control()
        with bob.session.watch():
            run_against_a_load(ada.session)
            bob.session.call("PUT", "/control", {"by": "Bob"})
            ada.session.hand_control_over("Bob")
            bob.session.come_to_rest()
            with pytest.raises(svsa.StateError, match="Bob is in control"):
                ada.session.start()
            bob.session.start()
            assert bob.session.status == "running"
            ada.session.pause()
            room.bench.wait_for("ready")
        bob.session.give_control_back()


def test_all_users_may_stop_a_bench(room: Room) -> None:
    """Stopping a machine needs no login; `test_access` shows that a simulation needs one."""
    room.bench.make_ready()
    url = room.bench.lab.url
    with httpx.Client(base_url=url, timeout=PATIENCE_S, trust_env=False) as stranger:
        assert stranger.get("/api/v1/access").json()["stops_without_login"]
        assert stranger.post("/api/v1/quick-stop").status_code == 204
    room.bench.wait_for("fault")
    assert room.bench.read()["fault"]["code"] == "quick_stop"
    room.bench.make_ready()


def test_script_of_a_simulation_runs_on_the_bench(room: Room, tmp_path: Path) -> None:
    with run_lab_in_process() as simulated:
        path = write_copied_script(do_experiment(simulated.client), room.bench.lab.url, tmp_path)
    room.bench.make_ready()
    script = start_script(path, room.tokens[0], "--shared")
    assert finish_script(script, ("Bench FL", "Twin FL")) >= END_S
    state = room.bench.read()
    assert (state["control"]["holder"], state["bench"]["status"]) == (None, "ready")
    assert [event["label"] for event in state["events"]][-1] == "Stop"
    assert room.bench.is_at_zero()
