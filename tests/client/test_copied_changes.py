"""The script of a run reproduces the configuration and the samples of the run."""

import runpy
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import svsa
from svsa.actuators.arm.parameters import RODS
from svsa.actuators.signals import CHANNEL_NAMES
from svsa.client.session import RemoteSession
from svsa.runs.definition.command import Set, build_command
from svsa.runs.session.simulated import SimulatedSession
from svsa.simulation.plant.effects.noise import SensorNoise
from svsa_server.routes.runs.origins import _build_origin
from tests.client.copied_script import LONGEST_S, bundle_writer, write_script
from tests.lab import run_lab
from tests.runs.session.scripts import ARGUMENTS
from tests.runs.session.sessions import build_session, read_samples

KINDS = sorted({*ARGUMENTS} - {"load", "unload", "stop"})
FIELDS = ("law", "position", "stiffness", "observer", "actuator", "nominal", "effects")
repeats = st.just(("repeat", "position")) | st.just(("repeat", "stiffness"))
changes = st.sampled_from(KINDS).flatmap(lambda kind: st.tuples(st.just(kind), ARGUMENTS[kind]))
scripts = st.lists(st.tuples(st.integers(0, 20), changes | repeats), min_size=3, max_size=10)


@pytest.fixture(scope="module")
def stand(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, Path]]:
    """The address of a lab, and a folder for scripts."""
    folder = tmp_path_factory.mktemp("scripts")
    bundle_writer(folder)
    with run_lab() as lab:
        yield lab.url, folder


def play(script: list) -> SimulatedSession:
    session = build_session(comparisons=(svsa.Lane(law="fl"),))
    for gap, (kind, argument) in script:
        session.step(gap)
        try:
            if kind == "repeat":
                kind, argument = argument, getattr(session.run.configuration, argument)
            session.change(build_command(0, kind, argument))
        except svsa.SvsaError:
            continue
        assume(session.run.fault is None)
    session.step(30)
    assume(session.run.fault is None)
    return session


def run_again(session: SimulatedSession, url: str, folder: Path) -> dict:
    """The final state of the session of a script."""
    journal, run = session.journal, session.run
    origin = _build_origin(
        journal.initial, journal.commands, (0, run.tick), "simulated", svsa.load_prototype()
    )
    return run_script(origin.model_dump(mode="json"), url, folder)


def run_script(origin: dict, url: str, folder: Path) -> dict:
    """The final state of the session of the script of an origin."""
    path = write_script(origin, url, folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "argv", [str(path)])
        return runpy.run_path(str(path))["state"]


def assert_same_run(session: SimulatedSession, state: dict) -> None:
    configuration = session.run.configuration.model_dump(mode="json")
    reported = state["configuration"]
    assert state["tick"] == session.run.tick
    assert {name: reported[name] for name in FIELDS} == {
        name: configuration[name] for name in FIELDS
    }
    assert configuration["gains"].items() <= reported["gains"].items()
    assert configuration["parameters"].items() <= reported["parameters"].items()
    lanes = tuple(svsa.Lane(**lane) for lane in reported["comparisons"])
    assert lanes == session.run.configuration.comparisons
    newest = dict(zip(CHANNEL_NAMES, read_samples(session)[-1].tolist(), strict=True))
    assert state["sample"] == newest


@pytest.mark.exhaustive
@settings(max_examples=6, deadline=None)
@given(scripts)
def test_script_reproduces_the_configuration_and_samples_of_its_run(
    stand: tuple[str, Path], script: list
) -> None:
    session = play(script)
    assert_same_run(session, run_again(session, *stand))


def test_script_restarts_a_reference(stand: tuple[str, Path]) -> None:
    session = build_session()
    session.step(40)
    session.change(Set("position", session.run.configuration.position))
    session.step(40)
    assert_same_run(session, run_again(session, *stand))


def operate_actuator(session: RemoteSession) -> None:
    """Change settings of another actuator before t = 0, and during the run."""
    session.actuator = {"link_inertia_kg_m2": 0.025}
    session.nominal = {"motor2_damping_nms_per_rad": 0.004}
    session.gains = svsa.Gains.from_poles([-40.0] * 4, [-30.0] * 2)
    noise = svsa.Effects(noise=SensorNoise(motor_std_rad=1e-6))
    session.set(stiffness=4.0, observer=50.0, effects=noise, comparisons="fl")
    session.reset()
    session.loads.add(svsa.ConstantLoad(torque_nm=(0.1, 0.0, 0.0), start_s=0.1))
    session.run_until(0.05)
    session.repeat_position()
    session.set_lane(2, "pd")
    session.run_until(0.2)
    session.actuator = {"link_damping_nms_per_rad": 0.01}
    session.loads.clear()
    session.run_until(0.3)


def operate_arm(session: RemoteSession) -> None:
    """Change settings of both joints and the arm before t = 0, and during the run."""
    joint1, joint2 = session.open_joint(1), session.open_joint(2)
    session.comparisons = "fl"
    joint2.set_lane(2, "pd")
    joint2.set(law="fl", effects="rig", position=0.2)
    joint1.set(stiffness=70.0, observer=40.0)
    joint1.nominal = {"link_inertia_kg_m2": 0.05}
    session.change_arm(
        links=RODS.change_link(2, mass_kg=0.25), adaptation=svsa.PayloadAdaptation(mass_max_kg=0.5)
    )
    session.loads.add(svsa.TipMass(mass_kg=0.05, start_s=0.1))
    session.run_until(0.05)
    joint2.loads.add(svsa.ConstantLoad(torque_nm=(0.1, 0.0, 0.0)))
    joint2.repeat_position()
    session.law = "ndobc"
    session.run_until(0.2)
    session.change_arm(feedforward=True)
    joint1.position = 0.1
    session.position = 0.2
    session.loads.remove(2)
    session.run_until(0.3)
    session.change_arm(adaptation=None)
    session.comparisons = ()
    session.run_until(0.4)


def operate_tip(session: RemoteSession) -> None:
    """Move the tip of an arm of different actuators."""
    tip = svsa.TipEllipse(center_m=(0.25, -0.3), radii_m=(0.02, 0.01), frequency_hz=0.2)
    session.change_arm(tip=tip)
    session.open_joint(2).stiffness = 5.0
    session.run_until(0.03)


def summarize(state: dict) -> dict:
    """Everything in the state of a session that its run determines."""
    names = ("tick", "configuration", "loads", "events", "sample", "window", "payload_kg")
    lanes = [lane["in_window"] | lane["since_start"] for lane in state["lanes"]]
    return {name: state[name] for name in names} | {"lanes": lanes}


@pytest.mark.parametrize(
    ("request_body", "operate"),
    [
        pytest.param(
            {"actuator": "qbmove", "law": "ndobc", "seed": 7}, operate_actuator, id="actuator"
        ),
        pytest.param(
            {"arm": "rods", "seed": 7}, operate_arm, id="arm", marks=pytest.mark.exhaustive
        ),
        pytest.param(
            {"arm": "maccepa", "actuators": ["maccepa", "qbmove"]},
            operate_tip,
            id="tip",
            marks=pytest.mark.exhaustive,
        ),
    ],
)
def test_script_repeats_the_run_of_any_actuator_and_arm(
    stand: tuple[str, Path], request_body: dict, operate: Callable[[RemoteSession], None]
) -> None:
    url, folder = stand
    with svsa.connect(url, timeout_s=LONGEST_S) as lab, lab.new_session(**request_body) as session:
        session.pause()
        session.reset()
        operate(session)
        state = session.read_state()
        origin = lab.connection.read(session.path + "/origin")
    assert summarize(run_script(origin, url, folder)) == summarize(state)
