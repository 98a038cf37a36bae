"""Measurements of the plant: signs and zeros, ages, gaps on the wire, any frame."""

import math
from itertools import pairwise

import can
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from svsa.actuators.signals import State, Torque
from svsa.hardware.description.calibration import Calibration, compute_fingerprint
from svsa.hardware.description.file import read_bench
from svsa.hardware.drives.drive import GATE_JITTER_S
from svsa.hardware.drives.robomodule import Command, split_id
from svsa.hardware.drives.robomodule.drive import GAP_S
from svsa.hardware.emulator.parameters import EmulatedDeflection, EmulatorParameters
from svsa.hardware.safety.machine import BenchStatus
from tests.hardware import wired_bench
from tests.hardware.wired_bench import AT_REST, EMULATOR_BENCH, WiredBench

PUSH = Torque(0.8, 0.25)
HOLD = Torque(0.02, 0.01)  # less than the friction, so that the axes stay at their marks
ZERO_COUNTS = -2500
COUNT1_RAD = 2.0 * math.pi / 2000 / 50
COUNT_PHI_RAD = 2.0 * math.pi / 8000


def build_bench(monkeypatch, signs, zero):
    """An emulator and a bench file of these signs (motor 1, 2, deflection), and its record."""
    parameters, bench = EmulatorParameters(), read_bench(EMULATOR_BENCH)
    for part, sign in zip(("motor1", "motor2", "deflection"), signs, strict=True):
        turned = getattr(parameters, part).changed(sign=sign)
        parameters = parameters.changed(**{part: turned})
        bench = bench.changed(**{part: getattr(bench, part).changed(sign=sign)})
    assert isinstance(parameters.deflection, EmulatedDeflection)
    deflection = parameters.deflection.changed(offset_counts=zero)
    parameters = parameters.changed(deflection=deflection)
    calibration = Calibration(
        date="2026-01-02T03:04:05+00:00",
        by="a test",
        fingerprint=compute_fingerprint(bench),
        deflection_zero_counts=zero,
        signs_confirmed=True,
    )
    monkeypatch.setattr(wired_bench, "find_calibration", lambda _: calibration)
    return WiredBench(bench, parameters)


@pytest.mark.parametrize("signs", [(1, 1, 1), (-1, -1, -1), (1, -1, 1), (-1, 1, -1)])
def test_positive_torque_increases_the_measured_angle_for_any_wiring(signs, monkeypatch):
    """The true state is that of the emulator at the time of the reading; the bench knows its
    velocity.

    The tolerance is half a count of rounding, plus the change by the velocity within the age of a
    frame.
    """
    with build_bench(monkeypatch, signs, ZERO_COUNTS) as b:
        b.make_run()
        for _ in range(60):
            b.tick(1, PUSH, known=b.emulator.mechanics.read(b.emulator.now_us))
            truth: State = b.emulator.mechanics.read(b.emulator.now_us)
            y = b.plant.read(b.now, truth).measurement
            assert y is not None
            assert y.theta1 == pytest.approx(truth.theta1, abs=COUNT1_RAD)
            assert y.theta2 == pytest.approx(truth.theta2, abs=COUNT1_RAD)
            assert y.phi == pytest.approx(truth.q - truth.theta1, abs=COUNT_PHI_RAD)
        assert truth.theta1 > 20.0 * COUNT1_RAD
        assert truth.theta2 > 20.0 * COUNT1_RAD
        assert b.plant.fault is None


def test_age_of_a_frame_is_an_error_without_extrapolation(monkeypatch):
    """The reading is extrapolated to the present: the raw reading has many counts of error."""
    with build_bench(monkeypatch, (1, 1, 1), 0) as b:
        b.make_run()
        for _ in range(60):
            b.tick(1, PUSH, known=b.emulator.mechanics.read(b.emulator.now_us))
        truth = b.emulator.mechanics.read(b.emulator.now_us)
        y = b.plant.read(b.now, AT_REST).measurement
        assert y is not None
        assert truth.theta1 - y.theta1 > 3.0 * COUNT1_RAD


def test_missing_feedback_is_not_measured():
    """Off, after a reset: the last angles and currents of a drive are obsolete."""
    with WiredBench() as b:
        b.tick(5)
        assert b.reading is not None
        assert b.reading.measurement is None
        b.make_run(PUSH)
        assert b.reading.measurement is not None
        b.plant.quick_stop(b.now, "a test")
        b.tick(100)
        assert b.reading.measurement is None
        assert b.reading.current_a == (0.0, 0.0)
        assert min(b.reading.ages_s[:2]) > 0.02


def list_gaps(b, number):
    """Return the times between commands that reached a drive, s; a broadcast reaches
    every drive.
    """
    times = [
        sent.time_s
        for sent in b.clock.sent
        if sent.can_id <= 0x7FF
        and split_id(sent.can_id)[0].number in (0, number)
        and split_id(sent.can_id)[1] <= Command.CONFIG
    ]
    return [later - earlier for earlier, later in pairwise(times)]


def test_no_drive_gets_two_commands_within_a_millisecond():
    """During arming, running, a fault, immediate clearing and arming, and the end."""
    b = WiredBench()
    b.plant.arm(b.now)
    b.tick_until(BenchStatus.READY)
    b.make_run(HOLD)
    b.plant.stop(b.now, "a test")
    b.tick_until(BenchStatus.READY, torque=HOLD)
    b.plant.start(b.now)
    b.tick(5, HOLD)
    b.plant.quick_stop(b.now, "a test")
    b.tick(1, HOLD)
    b.plant.clear(b.now)
    b.make_run(HOLD)
    b.plant.quick_stop(b.now, "a test")
    b.tick(5, HOLD)
    b.plant.clear(b.now)
    b.make_run(HOLD)
    b.plant.close()
    b.clock.collect()
    b.wire.shutdown()
    for number in (1, 2):
        gaps = list_gaps(b, number)
        assert len(gaps) > 100
        assert min(gaps) >= GAP_S - GATE_JITTER_S - 1e-9


FRAMES = st.builds(
    can.Message,
    timestamp=st.floats(allow_nan=False, allow_infinity=False),
    arbitration_id=st.one_of(
        st.sampled_from([0x01B, 0x02B, 0x01D, 0x02D, 0x01F, 0x700, 0x013, 0x000]),
        st.integers(0, 0x7FF),
    ),
    is_extended_id=st.booleans(),
    is_remote_frame=st.booleans(),
    is_error_frame=st.booleans(),
    data=st.binary(max_size=8),
)


@settings(
    max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(frames=st.lists(FRAMES, max_size=20))
def test_any_frame_leaves_the_tick_working(frames):
    """With any frames on the bus a tick reads and writes; its commands are zero or within the
    limits.
    """
    with WiredBench() as b:
        b.plant.arm(b.now)
        b.tick(3)
        for frame in frames:
            if frame.is_remote_frame:
                frame.data = bytearray()
            b.wire.send(frame)
            b.tick(1, PUSH)
        assert b.reading is not None
        assert all(age >= 0.0 for age in b.reading.ages_s)
        assert {current for _, _, current in b.read_currents()} <= {0}
