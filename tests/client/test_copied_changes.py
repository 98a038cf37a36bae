"""The script of a run gives the configuration and the samples of the run again."""

import runpy
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import svsa
from svsa.actuators.signals import CHANNEL_NAMES
from svsa.runs.command import Set, build_command
from svsa.runs.session.simulated import SimulatedSession
from svsa_server.routes.runs.origins import _tell
from tests.client.copied_script import bundle_writer, write_script
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
    """The address of a lab, and a folder in which scripts can be written."""
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
    """The state in which the script of a session ends."""
    journal, run = session.journal, session.run
    origin = _tell(
        journal.initial.model_dump(mode="json"),
        journal.commands,
        (0, run.tick),
        run.period_s,
        "simulated",
        svsa.load_prototype(),
    )
    path = write_script(origin.model_dump(mode="json"), url, folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "argv", [str(path)])
        return runpy.run_path(str(path))["state"]


def expect_same(session: SimulatedSession, state: dict) -> None:
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


@settings(max_examples=6, deadline=None)
@given(scripts)
def test_a_script_gives_the_configuration_and_the_samples_of_its_run(
    stand: tuple[str, Path], script: list
) -> None:
    session = play(script)
    expect_same(session, run_again(session, *stand))


def test_a_script_begins_a_reference_again(stand: tuple[str, Path]) -> None:
    session = build_session()
    session.step(40)
    session.change(Set("position", session.run.configuration.position))
    session.step(40)
    expect_same(session, run_again(session, *stand))
