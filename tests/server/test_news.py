"""What streams are told of a change is made once for all who are told the same."""

import json

import pytest

from svsa.paper import get_figure
from svsa.run.command import SetLaw
from svsa.session.simulated import SimulatedSession
from svsa_server import state
from svsa_server.control import Holder, asking
from svsa_server.hosted import HostedSession


@pytest.fixture
def hosted():
    return HostedSession(SimulatedSession("lab", get_figure("4a").build_configuration()))


def test_a_change_is_written_once_for_all_who_are_told_the_same(hosted, monkeypatch):
    written = []
    build = state.build_state
    monkeypatch.setattr(state, "build_state", lambda of: written.append(of) or build(of))
    texts = {state.write_news(hosted) for _ in range(100)}
    assert len(texts) == len(written) == 1
    hosted.session.start()
    assert json.loads(state.write_news(hosted))["state"]["status"] == "running"
    assert len(written) == 2


def test_who_is_in_control_is_told_so_and_nobody_else(hosted):
    hosted.take_control(Holder("ada", "Ada"), take_over=False)
    for client, is_ada in (("ada", True), ("bob", False), ("ada", True), (None, False)):
        asking.set(client)
        control = json.loads(state.write_news(hosted))["state"]["control"]
        assert (control["holder"], control["mine"]) == ("Ada", is_ada)


def test_what_moves_by_itself_is_written_once_in_each_period(hosted, monkeypatch):
    written = []
    build = state.build_progress
    monkeypatch.setattr(state, "build_progress", lambda of: written.append(of) or build(of))
    assert len({state.write_progress(hosted, period=7) for _ in range(100)}) == len(written) == 1
    state.write_progress(hosted, period=8)
    hosted.session.start()
    assert json.loads(state.write_progress(hosted, period=8))["state"]["status"] == "running"
    assert len(written) == 3


def test_a_window_is_fresh_in_its_first_seconds(hosted):
    assert state.is_fresh(hosted)
    for _ in range(4):
        hosted.session.step(1000)
    assert not state.is_fresh(hosted)
    hosted.session.change(SetLaw(argument="fl"))
    assert state.is_fresh(hosted)
