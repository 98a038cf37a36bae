"""Times of frames in the clock of the loop, and waits until absolute deadlines."""

import time

import can
import pytest

from svsa.hardware.bench.emulation import ADVANCE_ID, decode_time, encode_time
from svsa.hardware.description.file import read_bench
from svsa.hardware.plant.clock import (
    CATCH_UP_S,
    DRIFT,
    SPIN_S,
    ClockError,
    LockstepClock,
    PacedClock,
    WallClock,
    choose_clock,
)
from tests.hardware.wired_bench import EMULATOR_BENCH


class Adapter:
    """A bus that responds as an emulator in lockstep, or not at all. alone_us: its time without a
    loop.
    """

    def __init__(self, answers: bool = True) -> None:
        self.asked: list[int] = []
        self._waiting: list[can.Message] = []
        self._answers = answers
        self.alone_us = 0

    def send(self, message: can.Message) -> None:
        self.asked.append(decode_time(message.data))
        if self._answers:
            data = encode_time(max([*self.asked, self.alone_us]))
            self._waiting += [
                can.Message(arbitration_id=0x01B, is_extended_id=False, data=b"\x00" * 8),
                can.Message(arbitration_id=ADVANCE_ID, is_extended_id=True, data=data),
            ]

    def recv(self, timeout: float) -> can.Message | None:
        return self._waiting.pop(0) if self._waiting else None


def test_waits_until_a_deadline_and_not_for_a_past_one() -> None:
    clock = WallClock()
    deadline = clock.now() + 0.02
    clock.wait_until(deadline)
    late = clock.now()
    assert late >= deadline
    clock.wait_until(deadline - 10.0)
    assert clock.now() - late < 1.0


def test_near_deadline_is_never_early() -> None:
    clock = WallClock()
    for _ in range(200):
        deadline = clock.now() + 0.5 * SPIN_S
        clock.wait_until(deadline)
        assert clock.now() >= deadline


def test_time_of_day_stamps_are_converted_to_monotonic_time() -> None:
    clock = WallClock()
    clock.bind(None)  # pyright: ignore[reportArgumentType]
    now, of_day = time.monotonic(), time.time()
    assert clock.convert(of_day - 0.003, now) == pytest.approx(now - 0.003, abs=0.5)
    one = clock.convert(of_day - 0.003, now)
    assert clock.convert(of_day - 0.001, now) - one == pytest.approx(0.002, abs=0.01)


def test_frames_of_another_clock_are_converted_by_the_least_delay() -> None:
    """Origin 7 s after start-up: the frame with the least delay gives the offset."""
    clock = WallClock()
    clock.bind(None)  # pyright: ignore[reportArgumentType]
    for tick in range(100):
        sent = 1000.0 + 0.001 * tick
        waited = 0.0009 - 1e-5 * (tick % 90)
        reported = clock.convert(sent - 993.0, sent + waited)
    assert reported == pytest.approx(sent, abs=2e-5)


def test_drifting_clock_is_followed() -> None:
    """An adapter that is 100 ppm slow for an hour would otherwise appear 0.36 s late."""
    clock = WallClock()
    clock.bind(None)  # pyright: ignore[reportArgumentType]
    for tick in range(36_000):
        arrival = 50.0 + 0.1 * tick
        reported = clock.convert(7.0 + 0.1 * tick * (1.0 - 0.5 * DRIFT), arrival)
    assert reported == pytest.approx(arrival, abs=1e-4)


def test_late_frames_are_reported_as_late_and_a_new_origin_is_found() -> None:
    clock = WallClock()
    clock.bind(None)  # pyright: ignore[reportArgumentType]
    clock.convert(1.0, 100.0)
    assert clock.convert(1.01, 100.04) == pytest.approx(100.01, abs=1e-4), "30 ms late"
    assert clock.convert(0.0, 101.0) == pytest.approx(101.0), "the adapter has restarted"
    assert clock.convert(0.5, 101.5) == pytest.approx(101.5, abs=1e-3)


def test_lockstep_advances_the_rig_and_keeps_its_frames() -> None:
    clock, bus = LockstepClock(), Adapter()
    clock.bind(bus)  # pyright: ignore[reportArgumentType]
    assert clock.now() == 0.0
    clock.wait_until(0.0015)
    assert bus.asked[-1] == 1500
    assert clock.now() == 0.0015
    clock.wait_until(0.001)
    assert bus.asked[-1] == 1500, "no going back"
    assert len(clock.take_frames()) == 2
    assert clock.take_frames() == []
    assert clock.convert(1.25, 3.0) == 1.25


def test_silent_rig_is_an_error() -> None:
    with pytest.raises(ClockError, match="lockstep"):
        LockstepClock().wait_until(1.0)
    with pytest.raises(ClockError, match="lockstep"):
        LockstepClock().bind(Adapter(answers=False))  # pyright: ignore[reportArgumentType]


class Wall:
    """A wall clock that advances while it is waited for, and when a test advances it."""

    def __init__(self) -> None:
        self.time = 500.0

    def now(self) -> float:
        return self.time

    def wait_until(self, deadline: float) -> None:
        self.time = max(self.time, deadline)


def tick(clock: PacedClock, ticks: int) -> list[float]:
    """Run periods of 1 ms; return the delay of each on the wall clock."""
    late, deadline = [], clock.now()
    for _ in range(ticks):
        deadline += 0.001
        clock.wait_until(deadline)
        assert clock.now() == pytest.approx(deadline), "the emulator is never ahead of the loop"
        late.append(clock.find_lateness(deadline))
    return late


def test_paced_rig_is_synchronous_with_the_wall_clock_and_waits_for_a_late_loop() -> None:
    clock, wall = PacedClock(), Wall()
    clock._wall = wall  # pyright: ignore[reportAttributeAccessIssue]
    clock.bind(Adapter())  # pyright: ignore[reportArgumentType]
    assert tick(clock, 100) == pytest.approx([0.0] * 100, abs=1e-9)
    assert wall.time == pytest.approx(500.1)
    wall.time += 0.02
    late = tick(clock, 40)
    assert late[0] == pytest.approx(0.019)
    assert late[-1] == pytest.approx(0.0, abs=1e-9)
    assert wall.time == pytest.approx(500.14), "20 ms are made up for"
    wall.time += 1.0
    assert max(tick(clock, 200)) == pytest.approx(CATCH_UP_S)
    assert clock.now() == pytest.approx(0.34)
    assert wall.time == pytest.approx(501.34 - CATCH_UP_S, abs=0.002), "the rest is lost to both"


def test_rig_that_advanced_alone_is_not_waited_for() -> None:
    """While a loop was loading: its first tick is late, and the next is due a tick later."""
    clock, wall, emulator = PacedClock(), Wall(), Adapter()
    clock._wall = wall  # pyright: ignore[reportAttributeAccessIssue]
    clock.bind(emulator)  # pyright: ignore[reportArgumentType]
    for alone_s in (3.0, 8.0):
        emulator.alone_us, wall.time = round(alone_s * 1e6), wall.time + 3.0
        clock.wait_until(clock.now() + 0.001)
        assert clock.now() == alone_s
        begin = wall.time
        assert tick(clock, 100) == pytest.approx([0.0] * 100, abs=1e-9)
        assert wall.time == pytest.approx(begin + 0.1)


def test_bench_file_states_whether_the_rig_waits() -> None:
    bench = read_bench(EMULATOR_BENCH)
    assert isinstance(choose_clock(bench), WallClock)
    assert bench.emulator is not None
    waits = bench.changed(emulator=bench.emulator.changed(lockstep=True))
    assert isinstance(choose_clock(waits), PacedClock)
    assert isinstance(choose_clock(bench.changed(emulator=None)), WallClock)


def test_rig_that_advances_automatically_is_not_in_lockstep() -> None:
    bus = Adapter()
    clock = LockstepClock()
    clock.bind(bus)  # pyright: ignore[reportArgumentType]
    bus.asked = []
    bus.send = lambda _: bus._waiting.append(  # pyright: ignore[reportAttributeAccessIssue]
        can.Message(arbitration_id=ADVANCE_ID, is_extended_id=True, data=encode_time(3000))
    )
    with pytest.raises(
        ClockError, match=r"is at 0.003 s .* advance to 1 s: start it with --lockstep"
    ):
        clock.wait_until(1.0)
