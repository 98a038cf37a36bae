"""Control in a class: requested, queued for, handed over, locked, released; with given times."""

import asyncio
from types import SimpleNamespace

import pytest

from svsa.errors import StateError
from svsa_server.leases.lease import ControlLease, HeldError, Holder
from svsa_server.leases.queue import ControlQueue
from svsa_server.sessions.hosted import HostedSession

ADA, BOB, EVE = Holder("p-1", "Ada"), Holder("p-2", "Bob"), Holder("p-3", "Eve")
TEACHER = Holder("instructor", "Instructor")
IDLE_S, GONE_S = 90.0, 15.0


@pytest.fixture
def queue() -> ControlQueue:
    return ControlQueue("lab", lambda client: client == TEACHER.client, IDLE_S)


def ask(queue: ControlQueue, *people: Holder, now: float = 0.0) -> None:
    for person in people:
        queue.take(person, take_over=False, now=now)


def settle(queue: ControlQueue, now: float, here: tuple[Holder, ...] = (ADA, BOB, EVE)) -> list:
    for person in here:
        queue.hear(person.client, now)
    return queue.settle(now, GONE_S)


def test_free_session_is_commanded_by_the_instructor_only(queue: ControlQueue) -> None:
    assert [queue.admits(one) for one in (None, "p-1", TEACHER.client)] == [False, False, True]
    with pytest.raises(HeldError, match="No user is in control of session lab: request control"):
        queue.check("p-1")


def test_first_request_gets_control_and_others_wait_in_order(queue: ControlQueue) -> None:
    ask(queue, ADA, BOB, EVE, BOB, ADA)
    assert (queue.holder, queue.waiting) == (ADA, [BOB, EVE])
    assert [queue.find_place(one.client) for one in (ADA, BOB, EVE)] == [None, 1, 2]
    assert [queue.admits(one.client) for one in (ADA, BOB, TEACHER)] == [True, False, False]
    with pytest.raises(HeldError, match="Ada is in control of session lab: request control, and"):
        queue.check("p-2")


def test_released_control_passes_to_the_queue_without_those_who_left(
    queue: ControlQueue,
) -> None:
    ask(queue, ADA, BOB, EVE)
    queue.give_back("p-2", 1.0)
    assert (queue.holder, queue.waiting) == (ADA, [EVE])
    queue.give_back("p-1", 2.0)
    assert (queue.holder, queue.waiting) == (EVE, [])
    queue.give_back("p-1", 3.0)
    assert queue.holder == EVE, "who is in neither gives nothing back"
    queue.give_back("p-3", 4.0)
    assert queue.holder is None


def test_holder_hands_over_to_a_waiting_user_only(queue: ControlQueue) -> None:
    ask(queue, ADA, BOB, EVE)
    for other in ("p-2", None):
        with pytest.raises(HeldError):
            queue.hand_over(other, "p-3", 1.0)
    with pytest.raises(StateError, match="a user in the queue"):
        queue.hand_over("p-1", "p-9", 1.0)
    queue.hand_over("p-1", "p-3", 1.0)
    assert (queue.holder, queue.waiting) == (EVE, [BOB])
    queue.hand_over(TEACHER.client, "p-2", 2.0)
    assert (queue.holder, queue.waiting) == (BOB, [])


def test_idle_holder_loses_control_to_a_waiting_user_only(queue: ControlQueue) -> None:
    ask(queue, ADA)
    assert not settle(queue, 1000.0)
    assert queue.holder == ADA, "the queue is empty"
    ask(queue, ADA, now=1000.0)
    queue.note_command("p-1", 1000.0)
    ask(queue, BOB, now=1001.0)
    queue.note_command("p-2", 1060.0)
    assert not settle(queue, 1000.0 + IDLE_S)
    assert queue.holder == ADA
    assert settle(queue, 1000.1 + IDLE_S) == [(ADA, "idle")]
    assert queue.holder == BOB
    ask(queue, ADA, now=1100.0)
    queue.note_command("p-2", 1150.0)
    assert not settle(queue, 1230.0)
    assert queue.holder == BOB, "a command counts"


def test_absent_user_loses_control_and_place(queue: ControlQueue) -> None:
    ask(queue, ADA, BOB, EVE)
    assert not settle(queue, 14.0, (BOB,))
    assert settle(queue, 16.0, (EVE,)) == [(ADA, "gone")]
    assert (queue.holder, queue.waiting) == (BOB, [EVE])
    assert not settle(queue, 30.0, (EVE,))
    assert settle(queue, 32.0, ()) == [(BOB, "gone")]
    assert (queue.holder, queue.waiting) == (EVE, [])
    ask(queue, ADA, now=40.0)
    assert settle(queue, 56.0, (EVE,)) == [(ADA, "gone_from_queue")]
    assert (queue.holder, queue.waiting) == (EVE, [])
    assert settle(queue, 72.0, ()) == [(EVE, "gone")]
    assert queue.holder is None


def test_former_holder_is_first_after_the_instructor(
    queue: ControlQueue,
) -> None:
    ask(queue, ADA, BOB)
    with pytest.raises(HeldError, match="Only the instructor"):
        queue.take(BOB, take_over=True, now=1.0)
    queue.take(TEACHER, take_over=True, now=1.0)
    assert (queue.holder, queue.waiting) == (TEACHER, [ADA, BOB])
    queue.give_back(TEACHER.client, 2.0)
    assert (queue.holder, queue.waiting) == (ADA, [BOB])


def test_only_the_instructor_commands_while_locked(queue: ControlQueue) -> None:
    ask(queue, ADA, BOB)
    queue.lock(True, 1.0)
    assert (queue.holder, queue.waiting) == (None, [ADA, BOB])
    with pytest.raises(HeldError, match="The instructor has locked control"):
        queue.check("p-1")
    ask(queue, EVE, now=2.0)
    assert not settle(queue, 10.0)
    assert queue.holder is None
    assert queue.admits(TEACHER.client)
    queue.lock(False, 20.0)
    assert (queue.holder, queue.waiting) == (ADA, [BOB, EVE])


class Bench(SimpleNamespace):
    """A moving session, which stores why it was stopped."""

    def __init__(self, plant: str = "bench", status: str = "running") -> None:
        super().__init__(name="lab", plant=plant, status=status, version=0, halts=[])

    def halt(self, why: str) -> None:
        self.halts.append(why)
        self.status = "paused"


def host(lease: ControlLease, bench: Bench) -> HostedSession:
    return HostedSession(bench, lease=lease)  # type: ignore[arg-type]


def test_bench_is_stopped_whenever_control_changes(queue: ControlQueue) -> None:
    changes = (
        lambda hosted: hosted.give_control_back("p-1"),
        lambda hosted: hosted.hand_control_over("p-1", "p-2"),
        lambda hosted: hosted.take_control(TEACHER, True),
        lambda hosted: hosted.lock_control(True),
        lambda hosted: hosted.release_if_left(float("inf"), GONE_S),
    )
    for change in changes:
        bench = Bench()
        hosted = host(ControlQueue("lab", lambda client: client == TEACHER.client, 90.0), bench)
        hosted.take_control(ADA, False)
        hosted.take_control(BOB, False)
        assert bench.halts == [], "asking moves nothing"
        change(hosted)
        assert hosted.lease.holder != ADA
        assert bench.halts == ["control was handed over"]


def test_simulation_and_open_bench_continue_when_control_changes() -> None:
    simulated, bench = Bench(plant="simulated"), Bench()
    hosted = host(ControlQueue("lab", lambda _: False, 90.0), simulated)
    hosted.take_control(ADA, False)
    hosted.give_control_back("p-1")
    free = host(ControlLease("lab"), bench)
    free.take_control(ADA, False)
    free.take_control(ADA, True)
    free.give_control_back("p-1")
    assert simulated.halts == bench.halts == []
    free.take_control(ADA, False)
    free.take_control(BOB, True)
    assert bench.halts == ["control was handed over"]


def test_streams_keep_a_place_in_the_queue() -> None:
    hosted = host(ControlQueue("lab", lambda _: False, 1e9), Bench(status="paused"))
    hosted.touch = lambda: None  # type: ignore[method-assign]

    async def wait() -> None:
        hosted.take_control(ADA, False)
        hosted.take_control(BOB, False)
        with hosted.streamed_to("p-1"), hosted.streamed_to("p-2"):
            hosted.release_if_left(1e8, GONE_S)
        assert hosted.find_queue().find_place("p-2") == 1

    asyncio.run(wait())
