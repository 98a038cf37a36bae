"""A loop that is late once: its state estimate continues, and no wrong motion follows."""

import numpy as np
import pytest

from svsa.actuators.signals import State
from svsa.errors import StateError
from svsa.hardware.realtime.configuration import build_bench_configuration, read_actuation
from svsa.hardware.realtime.loop import BenchLoop
from svsa.hardware.realtime.memory import SampleArray
from svsa.hardware.safety.machine import BenchStatus
from svsa.runs.definition.command import Set
from svsa.runs.definition.paper import get_figure
from tests.hardware.wired_bench import WiredBench

MOVING_TICKS = 400
"""Figure 4A has faded in by then, and the link moves at 1.3 rad/s."""


def begin(bench: WiredBench) -> BenchLoop:
    """The loop of the bench on Figure 4A, at tick 0."""
    wanted = get_figure("4a").build_configuration(load=False)
    configuration = build_bench_configuration(bench.bench, wanted)
    actuation, mu0 = read_actuation(bench.bench), bench.bench.home.lever_ratio
    sink = SampleArray(MOVING_TICKS + 100)
    loop = BenchLoop(bench.plant, actuation, mu0, configuration, sink)
    bench.plant.arm(bench.now)
    while bench.plant.status is not BenchStatus.READY:
        bench.drive(loop)
    while (step := bench.plant.homing_step) is not None:
        bench.plant.confirm_home(step, "a test")
    bench.drive(loop, 20)
    loop.start(bench.now)
    return loop


def read(bench: WiredBench) -> State:
    """Return the true state."""
    return bench.emulator.mechanics.read(bench.emulator.now_us)


def test_late_tick_causes_no_false_velocity() -> None:
    """The motion of an axis in 15 ms, attributed to one tick, is a velocity of 5 instead of 2
    rad/s, and the torque commanded for it makes it true: the fourth time the motor turns at 22
    rad/s.
    """
    with WiredBench() as bench:
        loop = begin(bench)
        bench.drive(loop, MOVING_TICKS)
        for late in (5, 10, 15, 19):
            bench.skip(late * bench.bench.timing.period_s)
            bench.drive(loop, missed=late)
            assert float(loop._known[3]) == pytest.approx(read(bench).dtheta1, abs=0.3)
            fastest = 0.0
            for _ in range(100):
                bench.drive(loop)
                fastest = max(fastest, abs(read(bench).dtheta1))
            assert fastest < 4.0, f"{late} ms late"
            assert read(bench).dq > 0.5, "it moves on"
        assert bench.plant.fault is None


def test_time_of_a_run_advances_while_ticks_are_missed() -> None:
    """Each has its number and no sample, and the references are those of real time."""
    with WiredBench() as bench:
        loop = begin(bench)
        assert isinstance(loop.sink, SampleArray)
        bench.drive(loop, MOVING_TICKS)
        begun_s = bench.now - (loop.run.tick - 1) * loop.run.period_s
        bench.skip(12 * bench.bench.timing.period_s)
        bench.drive(loop, missed=12)
        bench.drive(loop, 9)
        rows = loop.sink.samples[: loop.sink.done]
        assert len(rows) == MOVING_TICKS + 12 + 10
        missed = np.isnan(rows).all(axis=1)
        assert np.flatnonzero(missed).tolist() == list(range(MOVING_TICKS, MOVING_TICKS + 12))
        assert rows[-1, 0] == pytest.approx(bench.now - begun_s, abs=1e-9)
    with WiredBench() as bench:
        punctual = begin(bench)
        bench.drive(punctual, len(rows))
        assert isinstance(punctual.sink, SampleArray)
        wanted = punctual.sink.samples[len(rows) - 1, :4]
    assert rows[-1, :4] == pytest.approx(wanted), "time, q_d, its velocity, σ_d"


def test_fault_after_missed_ticks_has_the_time_of_the_run() -> None:
    with WiredBench() as bench:
        loop = begin(bench)
        bench.drive(loop, MOVING_TICKS)
        bench.skip(25 * bench.bench.timing.period_s)
        bench.drive(loop, missed=25)
        assert bench.plant.fault is not None
        assert bench.plant.fault.code == "missed_ticks"
        assert bench.plant.fault.tick == MOVING_TICKS + 25
        assert loop.run.tick == MOVING_TICKS + 26


def test_server_does_not_wait_for_ticks_after_silence() -> None:
    """The supervisor has reset the drives meanwhile: nothing is measured, and the run has ended."""
    with WiredBench() as bench:
        loop = begin(bench)
        assert isinstance(loop.sink, SampleArray)
        bench.drive(loop, MOVING_TICKS)
        bench.clock.mute = True
        bench.skip(100 * bench.bench.timing.period_s)
        bench.drive(loop, missed=100)
        assert bench.plant.fault is not None
        assert loop.change(Set("law", "fl")) == loop.sink.done == MOVING_TICKS


def test_missed_ticks_before_the_first_one_are_not_of_the_run() -> None:
    """The start of a run takes the loop longer than a tick."""
    with WiredBench() as bench:
        loop = begin(bench)
        bench.skip(3 * bench.bench.timing.period_s)
        bench.drive(loop, missed=3)
        assert loop.run.tick == 1


def test_read_during_a_fault_reports_the_fault() -> None:
    """The reset drives send nothing; the error must not be that nothing was read yet."""
    with WiredBench() as bench:
        loop = begin(bench)
        bench.drive(loop, 10)
        bench.plant.quick_stop(bench.now, "a test")
        bench.drive(loop, 100)
        with pytest.raises(StateError, match="The bench is fault"):
            loop.start(bench.now)


def test_link_displaced_by_a_load_starts_no_run() -> None:
    """A load that remains after a stop keeps turning the link; the motors have no torque."""
    with WiredBench() as bench:
        loop = begin(bench)
        bench.drive(loop, 10)
        bench.plant.stop(bench.now, "a test")
        while bench.plant.status is not BenchStatus.READY:
            bench.drive(loop)
        loop._known[0] = 21.0
        with pytest.raises(StateError, match=r"21\.0 rad from its mark.*remove every hanging load"):
            loop.start(bench.now)
        loop.load(loop.run.configuration)
        assert bench.plant.status is BenchStatus.READY


LATE_TICKS = 60


def test_late_feedback_is_no_frozen_encoder_and_causes_no_wrong_motion() -> None:
    """The bench file keeps the torque for 0.9 s: x̂ continues by its model meanwhile.

    If x̂ continued with its velocity instead, an error would grow fourfold in each tick after 60
    ms.
    """
    with WiredBench(stale_zero_s=0.9, stale_fault_s=1.0) as bench:
        loop = begin(bench)
        bench.drive(loop, MOVING_TICKS)
        bench.clock.mute = True
        for _ in range(LATE_TICKS):
            bench.drive(loop)
            known = float(loop._known[3])
            assert known == pytest.approx(read(bench).dtheta1, abs=1.5), bench.plant.fault
        bench.clock.mute = False
        bench.drive(loop, 300)
        assert bench.plant.fault is None
        assert read(bench).dq > 0.5, "it moves on"
