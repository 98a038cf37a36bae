"""The heat of a bench's motors: in the state, as events, and predicted before a load is added."""

import asyncio
from collections.abc import Iterator

import pytest

from svsa.errors import StateError
from svsa.hardware.safety.machine import BenchStatus
from svsa.hardware.session.session import BenchSession
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.paper import PaperLoad
from svsa_server.routes.hardware.bench import predict_heat
from svsa_server.sessions.hosted import HostedSession
from svsa_server.sessions.state import build_state
from tests.runs.session.sessions import build_session

from .scripted_bench import build_bench_session, receive, say


@pytest.fixture
def session(monkeypatch: pytest.MonkeyPatch) -> Iterator[BenchSession]:
    made = build_bench_session(monkeypatch)
    made.open()
    yield made
    made.close()


def report(session: BenchSession, status: BenchStatus, *limited: str) -> None:
    say(session, status, limited)
    receive(session)


def list_events(session: BenchSession) -> list[tuple[str, str]]:
    return [(event.kind, event.label) for event in session.journal.events]


def test_start_and_end_of_a_heat_limit_are_events(session: BenchSession) -> None:
    report(session, BenchStatus.RUN)
    report(session, BenchStatus.RUN, "motor2")
    report(session, BenchStatus.RUN, "motor2")
    report(session, BenchStatus.RUN, "motor1", "motor2")
    report(session, BenchStatus.RUN, "motor2")
    assert list_events(session) == [
        ("heat_limit_began", "Torque of motor 2 limited by heat"),
        ("heat_limit_began", "Torque of motor 1 limited by heat"),
        ("heat_limit_ended", "Torque of motor 1 no longer limited by heat"),
    ]


def test_bench_at_rest_requests_nothing_of_a_warm_motor(session: BenchSession) -> None:
    report(session, BenchStatus.RUN, "motor2")
    report(session, BenchStatus.READY)
    report(session, BenchStatus.RUN, "motor2")
    assert [kind for kind, _ in list_events(session)] == ["heat_limit_began", "heat_limit_began"]


def test_state_has_the_heat_of_both_motors_while_the_loop_ticks(session: BenchSession) -> None:
    fields = session.loop.memory.fields
    fields["heat"], fields["allowed_nm"], fields["is_limited_by_heat"] = (
        (0.1, 0.99),
        (15.0, 1.6),
        (0, 1),
    )
    fields["skipped"], fields["skipped_in_run"] = 64, 3
    bench = build_state(HostedSession(session)).bench
    assert bench is not None
    assert bench.motors is not None
    one, two = bench.motors
    assert (one.heat, one.allowed_torque_nm, one.limited_by_heat) == (0.1, 15.0, False)
    assert (two.heat, two.allowed_torque_nm, two.limited_by_heat) == (0.99, 1.6, True)
    assert two.lasting_torque_nm == pytest.approx(1.2215, abs=1e-4)
    assert (bench.loop.skipped_ticks, bench.loop.skipped_in_run) == (64, 3)


def test_heat_is_unknown_while_no_loop_ticks(monkeypatch: pytest.MonkeyPatch) -> None:
    starting = build_bench_session(monkeypatch)
    bench = build_state(HostedSession(starting)).bench
    starting.close()
    assert bench is not None
    assert bench.motors is None


def test_permitted_time_of_a_load_is_reported_before_it_is_added(
    session: BenchSession,
) -> None:
    hosted = HostedSession(session)
    found = asyncio.run(predict_heat(hosted, PaperLoad()))
    assert found is not None
    assert found.motor == "motor2"
    assert 2.0 < found.seconds < 6.0
    assert found.lasting_torque_nm == pytest.approx(1.2215, abs=1e-4)
    assert found.torque_nm > found.lasting_torque_nm
    assert asyncio.run(predict_heat(hosted, MassLoad())) is None
    assert session.journal.commands == []


def test_simulation_has_no_motor_heat() -> None:
    with pytest.raises(StateError, match="is simulated"):
        asyncio.run(predict_heat(HostedSession(build_session()), PaperLoad()))
