"""Changes in the streams: one message for equal content, ended items once."""

import json
import random

import pytest

from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.runs.definition.command import ApplyLoad, Command, Set
from svsa.runs.definition.design import Lane
from svsa.runs.definition.paper import get_figure
from svsa.runs.session.simulated import SimulatedSession
from svsa.simulation.plant.loads.paper import PaperLoad
from svsa_server.leases.lease import Holder, asking
from svsa_server.sessions import broadcast
from svsa_server.sessions.broadcast import Broadcast, SentPast
from svsa_server.sessions.cursor import SampleCursor, StreamRequest
from svsa_server.sessions.hosted import HostedSession
from svsa_server.sessions.state import build_state


@pytest.fixture
def hosted():
    return HostedSession(SimulatedSession("lab", get_figure("4a").build_configuration()))


def slide(step: int) -> Command:
    """A dragged slider: another observer gain each time."""
    return Set("observer", ObserverBandwidth(bandwidth_rad_per_s=(70.0 + step,) * 3))


def read(sent_past: Broadcast) -> dict:
    return json.loads(sent_past.text)


def test_change_is_serialized_once_for_clients_with_the_same_content(hosted, monkeypatch):
    written = []
    build = broadcast.build_state
    monkeypatch.setattr(broadcast, "build_state", lambda *of: written.append(of) or build(*of))
    sent_past = SentPast.all_of(hosted)
    messages = {broadcast.write_broadcast(hosted, sent_past) for _ in range(100)}
    assert len(messages) == len(written) == 1
    hosted.session.start()
    assert read(broadcast.write_broadcast(hosted, sent_past))["state"]["status"] == "running"
    assert len(written) == 2


def test_clients_of_different_age_receive_the_same_from_the_first_change_on(hosted):
    came = []
    for _ in range(5):
        hosted.session.step(10)
        came.append(SentPast.all_of(hosted))
    hosted.session.set_speed(2.0)
    then = {broadcast.write_broadcast(hosted, sent_past) for sent_past in came}
    assert len({message.text for message in then}) == 5
    assert len({message.sent for message in then}) == 1


def test_only_the_holder_of_control_is_notified(hosted):
    hosted.take_control(Holder("ada", "Ada"), take_over=False)
    sent_past = SentPast.all_of(hosted)
    for client, is_ada in (("ada", True), ("bob", False), ("ada", True), (None, False)):
        asking.set(client)
        control = read(broadcast.write_broadcast(hosted, sent_past))["state"]["control"]
        assert (control["holder"], control["mine"]) == ("Ada", is_ada)


def test_continuous_values_are_serialized_once_per_period(hosted, monkeypatch):
    written = []
    build = broadcast.build_progress
    monkeypatch.setattr(broadcast, "build_progress", lambda *of: written.append(of) or build(*of))
    sent_past = SentPast.all_of(hosted)
    assert len({broadcast.write_progress(hosted, sent_past, period=7) for _ in range(100)}) == 1
    broadcast.write_progress(hosted, sent_past, period=8)
    assert len(written) == 2
    hosted.session.start()
    assert (
        read(broadcast.write_progress(hosted, sent_past, period=8))["state"]["status"] == "running"
    )
    assert len(written) == 3


def test_window_is_fresh_in_its_first_seconds(hosted):
    assert broadcast.is_fresh(hosted)
    for _ in range(4):
        hosted.session.step(1000)
    assert not broadcast.is_fresh(hosted)
    hosted.session.change(Set("law", "fl"))
    assert broadcast.is_fresh(hosted)


def test_message_size_does_not_grow_with_the_changes_of_a_minute(hosted):
    """A dragged slider notifies a hundred browsers of each of its steps."""
    sent_past, sizes = SentPast.all_of(hosted), []
    for step in range(200):
        hosted.session.step(20)
        hosted.session.change(slide(step))
        message = broadcast.write_broadcast(hosted, sent_past)
        sent_past = message.sent
        sizes.append(len(message.text))
    assert len(build_state(hosted).model_dump_json()) > 10 * sizes[-1]
    assert max(sizes[5:]) < 1.2 * sizes[5]


def join(known: dict, message: dict) -> dict:
    """Return the state of a reader after a message, as the schema defines it."""
    since, state = message["since_tick"], message["state"]
    was = {lane["id"]: lane["segments"] for lane in known["lanes"]}
    for lane in state["lanes"]:
        over = [one for one in was.get(lane["id"], []) if one["end_tick"] is not None]
        lane["segments"] = [o for o in over if o["end_tick"] < since] + lane["segments"]
    if "events" in state:
        before = [event for event in known["events"] if event["tick"] < since]
        state["events"] = before + state["events"]
        over = [window for window in known["ended_windows"] if window["end_tick"] < since]
        state["ended_windows"] = over + state["ended_windows"]
    return known | state


def do_something(session: SimulatedSession, dice: random.Random) -> None:
    match 3 if session.status == "fault" else dice.randrange(8):
        case 0:
            laws = dice.choices(("fl", "ndobc"), k=dice.randrange(3))
            session.change(Set("comparisons", tuple(Lane(law=law) for law in laws)))
        case 1:
            session.change(Set("law", dice.choice(("fl", "ndobc"))))
        case 2:
            session.change(ApplyLoad(argument=PaperLoad()))
        case 3:
            session.reset()
        case _:
            session.change(slide(dice.randrange(4)))


@pytest.mark.parametrize("seed", range(3))
def test_merged_messages_give_the_state_of_the_session(hosted, seed):
    """Also for a reader that receives some changes late, together."""
    dice, session = random.Random(seed), hosted.session  # noqa: S311
    sent_past, known = SentPast.all_of(hosted), json.loads(build_state(hosted).model_dump_json())
    for number in range(100):
        do_something(session, dice)
        session.journal.advance(dice.choice((0, 1, 5, 40)))
        if dice.random() < 0.3:
            continue
        message = broadcast.write_broadcast(hosted, sent_past)
        sent_past, known = message.sent, join(known, read(message))
        version = hosted.version
        session.journal.advance(dice.choice((0, 1, 40)))
        if hosted.version != version:
            continue
        message = broadcast.write_progress(hosted, sent_past, number)
        sent_past, known = message.sent, join(known, read(message))
        there = json.loads(build_state(hosted).model_dump_json())
        for sent_part in ("events", "ended_windows", "lanes"):
            assert known[sent_part][-50:] == there[sent_part][-50:], sent_part


def test_samples_are_packed_once_for_clients_at_the_same_position(hosted):
    def open_cursor(*channels: str) -> SampleCursor:
        return SampleCursor(hosted.session, StreamRequest(), channels, hosted.batches)

    alike = [open_cursor("position_rad") for _ in range(3)]
    other = open_cursor("stiffness_nm_per_rad")
    for _ in range(2):
        hosted.session.step(50)
        batches = [cursor.take_batch(slow=False) for cursor in alike]
        assert len({id(batch) for batch in batches}) == 1
        assert batches[0] != other.take_batch(slow=False)
