"""The lane of a sample in the stream: a lane keeps its id while others are added and removed."""

import numpy as np

from svsa.actuators.signals import CHANNEL_INDEX
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.runs.definition.command import ApplyLoad, Set
from svsa.runs.definition.design import Lane
from svsa.runs.definition.paper import get_figure
from svsa.runs.session.frame import HEADER
from svsa.runs.session.session import Session
from svsa.runs.session.simulated import SimulatedSession
from svsa_server.schemas.lab.stream import StreamRequest
from svsa_server.sessions.cursor import SampleCursor
from svsa_server.sessions.hosted import HostedSession
from svsa_server.sessions.state import build_state

FL = Lane(law="fl")
FASTER = Lane(law="ndobc", observer=ObserverBandwidth(bandwidth_rad_per_s=(120.0, 120.0, 120.0)))
ERROR = "position_error_rad"


def open_session() -> Session:
    """Three lanes after 0.2 s, with three errors that differ."""
    session = SimulatedSession(
        "lab", get_figure("4a").build_configuration().changed(comparisons=(FL, FASTER))
    )
    session.change(ApplyLoad(argument={"kind": "paper"}))
    session.step(200)
    return session


def read_ids(session: Session) -> list[int]:
    return [lane.id for lane in build_state(HostedSession(session)).lanes]


def read_batch(session: Session, cursor: SampleCursor) -> dict[int, np.ndarray]:
    """Return the error of every lane by its id in the batch."""
    message = cursor.take_batch(slow=False)
    assert message is not None
    *_, count, _, lanes = HEADER.unpack(message[: HEADER.size])
    begin = HEADER.size + 4 * lanes
    ids = np.frombuffer(message[HEADER.size : begin], "<u4").tolist()
    samples = np.frombuffer(message[begin:], "<f4").reshape(count, lanes)
    return dict(zip(ids, samples.T, strict=True))


def open_cursor(session: Session, lanes: tuple[int, ...] | None = None) -> SampleCursor:
    return SampleCursor(
        session, StreamRequest(rate_hz=1000.0, history_s=1.0, lanes=lanes), (ERROR,)
    )


def test_lane_keeps_its_id_when_the_previous_one_is_removed() -> None:
    session = open_session()
    cursor = open_cursor(session)
    before = read_batch(session, cursor)
    assert read_ids(session) == list(before) == [1, 2, 3]
    session.change(Set("comparisons", (FASTER,)))
    session.step(50)
    after = read_batch(session, cursor)
    assert read_ids(session) == list(after) == [1, 3]
    row = session.journal.history.read(200, 1, [CHANNEL_INDEX[ERROR]], [1])[:, 0, 0].astype("<f4")
    assert after[3].tolist() == row.tolist()
    assert abs(after[3][0] - before[3][-1]) < 1e-4 < abs(after[3][0] - before[2][-1])


def test_added_lane_has_a_new_id() -> None:
    session = open_session()
    session.change(Set("comparisons", (FASTER,)))
    session.change(Set("comparisons", (FL, FASTER)))
    session.step(10)
    assert read_ids(session) == [1, 4, 3]
    assert list(read_batch(session, open_cursor(session, lanes=(2,)))) == [4]


def test_new_run_numbers_its_lanes_again() -> None:
    session = open_session()
    session.change(Set("comparisons", (FASTER,)))
    session.reset()
    assert read_ids(session) == [1, 2]
