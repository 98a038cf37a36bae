"""Short pulses of current, and the resulting motion of motor and deflection.

The pulses grow from 1 % to 15 % of the motor's nominal current and get shorter as they grow, so
that a motor with a dead encoder gets no larger impulse than one with a working encoder. A motor
that has moved gets one more pulse in each direction, which ends after a given travel: its trace is
long enough to compare magnitudes.
"""

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from svsa.hardware.bench.settings import MotorSettings
from svsa.hardware.commissioning.probe import Probe
from svsa.hardware.commissioning.traffic import Traffic
from svsa.hardware.drives.conversion import build_deflection_scale, build_motor_scale

LEVELS = (0.01, 0.02, 0.03, 0.05, 0.08, 0.11, 0.15)
LONGEST_PULSE_S = 0.15
IMPULSE_S = 0.003
MAX_TRAVEL_RAD = 0.03
MIN_COUNTS = 8
MIN_DEFLECTION_COUNTS = 4
COAST_S = 0.02
"""Time for which a motor's counts are read after a pulse, s: both lag behind the current."""
SETTLE_S = 0.2
REST_S = 0.5
"""Maximum time that a pulse waits for the motor to rest, within `STILL_COUNTS`, s."""
STILL_COUNTS = 2
MAX_UNHEARD = 0.25
"""A pulse is valid if its longest time without feedback is at most this share of it."""
MAX_REPEATS = 5
"""Maximum number of invalid pulses per motor, which limits the impulse."""
_SEND_S = 0.002


class Trace(NamedTuple):
    """A pulse and the motion after it, at the times of the motor's feedback; arrays of shape (n,).

    Attributes:
        time_s: Time since the first feedback, s.
        moved: Change of the motor's counts.
        deflected: Counts of the deflection encoder.
        current_ma: Current measured by the drive, mA.
    """

    time_s: np.ndarray
    moved: np.ndarray
    deflected: np.ndarray
    current_ma: np.ndarray


NO_TRACE = Trace(*(np.zeros(0) for _ in Trace._fields))


class Pulse(NamedTuple):
    """The result of a pulse.

    Attributes:
        current_ma: Commanded current, mA.
        duration_s: Commanded duration, s.
        moved: Largest change of the motor's counts, in either direction.
        deflected: Largest change of the deflection's counts, in either direction.
        measured_ma: Largest measured current with its sign, mA.
        errors: Errors of the drive.
        unheard_s: Longest time without feedback during the pulse, s.
        trace: The trace.
    """

    current_ma: int
    duration_s: float
    moved: int = 0
    deflected: int = 0
    measured_ma: int = 0
    errors: int = 0
    unheard_s: float = math.inf
    trace: Trace = NO_TRACE


class Turn(NamedTuple):
    """A pulse and its reverse."""

    forth: Pulse
    back: Pulse

    @property
    def errors(self) -> int:
        """Return the number of errors that the drive reported in both."""
        return self.forth.errors + self.back.errors

    @property
    def unheard_s(self) -> float:
        """The longest time of either without feedback."""
        return max(self.forth.unheard_s, self.back.unheard_s)

    @property
    def was_followed(self) -> bool:
        """Whether there was enough feedback to judge the motor."""
        return self.unheard_s <= MAX_UNHEARD * self.forth.duration_s


def turn_a_little(probe: Probe, name: str) -> Turn:
    """Pulse a motor with increasing strength until the result is conclusive; return the last pulse.

    A turn without continuous feedback, because computer or bus paused, is repeated.
    """
    levels = list(reversed(LEVELS))
    repeats = MAX_REPEATS
    while True:
        turn = _turn(probe, name, levels[-1])
        if turn.was_followed:
            levels.pop()
        else:
            repeats -= 1
        if turn.errors or not levels or repeats < 0:
            return turn
        if turn.was_followed and _is_clear(name, turn.forth):
            return turn


def turn_farther(probe: Probe, name: str, turn: Turn) -> Turn:
    """Pulse a motor with the next current until it or the spring has moved far enough.

    Only for a motor that has been shown to move and count, because no impulse limits these pulses.
    """
    nominal_ma = 1e3 * getattr(probe.bench, name).nominal_current_a
    level = abs(turn.forth.current_ma) / nominal_ma
    stronger = next((each for each in LEVELS if each > 1.1 * level), LEVELS[-1])
    for _ in range(MAX_REPEATS):
        turn = _turn(probe, name, stronger, LONGEST_PULSE_S)
        if turn.was_followed:
            break
    return turn


def _turn(probe: Probe, name: str, level: float, duration_s: float = 0.0) -> Turn:
    """Send one pulse; `level` is the share of the nominal current, `duration_s` a maximum, or 0 for
    the usual impulse.
    """
    motor: MotorSettings = getattr(probe.bench, name)
    current_ma = (motor.sign or 1) * round(1e3 * level * motor.nominal_current_a)
    duration_s = duration_s or min(LONGEST_PULSE_S, IMPULSE_S / level)
    forth = _pulse(probe, name, current_ma, duration_s)
    return Turn(forth, _pulse(probe, name, -current_ma, duration_s))


def _is_clear(name: str, pulse: Pulse) -> bool:
    """Whether the motor has moved, and with motor 1 the deflection as well."""
    deflected = name != "motor1" or abs(pulse.deflected) >= MIN_DEFLECTION_COUNTS
    return abs(pulse.moved) >= MIN_COUNTS and deflected


def _get_most_counts(motor: MotorSettings) -> float:
    """Counts at which a pulse ends: 0.03 rad, or a tenth of a motor turn where unknown."""
    if motor.counts_per_rev and motor.gear_ratio:
        return MAX_TRAVEL_RAD / abs(build_motor_scale(motor).angle_per_count)
    return 0.1 * (motor.counts_per_rev or 1000)


def _pulse(probe: Probe, name: str, current_ma: int, duration_s: float) -> Pulse:
    """Command a current for this time, or until motor or spring has moved far enough."""
    before = _await_rest(probe, name)
    if not (before.feedback.get(name) and before.deflection):
        return Pulse(current_ma, duration_s)
    start = before.feedback[name][-1].counts
    spring = before.deflection[-1].counts
    most = _get_most_counts(getattr(probe.bench, name))
    most_spring = MAX_TRAVEL_RAD / abs(build_deflection_scale(probe.bench.deflection))
    traffic, begin = Traffic(), probe.now()
    end = begin + duration_s
    try:
        while probe.now() < end and not traffic.errors.get(name):
            probe.send_current(name, current_ma)
            for _ in probe.follow(_SEND_S, traffic):
                pass
            moved, deflected = _find_travel(traffic, name, start, spring)
            if abs(moved) >= most or abs(deflected) >= max(most_spring, MIN_COUNTS):
                break
    finally:
        probe.send_current(name, 0)
    heard = traffic.feedback.get(name, [])
    times = [begin, *(frame.time_s for frame in heard), probe.now()]
    unheard = max(later - earlier for earlier, later in pairwise(times))
    measured = max((frame.current_ma for frame in heard), key=abs, default=0)
    _, deflected = _find_travel(traffic, name, start, spring)
    for _ in probe.follow(COAST_S, traffic):
        pass
    moved, _ = _find_travel(traffic, name, start, spring)
    for _ in probe.follow(SETTLE_S - COAST_S, traffic):
        pass
    errors = traffic.errors.get(name, 0)
    trace = _build_trace(traffic, name, start, probe.bench.deflection.source == "can")
    return Pulse(current_ma, duration_s, moved, deflected, measured, errors, unheard, trace)


def _await_rest(probe: Probe, name: str) -> Traffic:
    """Wait until the motor is at rest, at most 0.5 s; return the traffic of the last 20 ms."""
    end = probe.now() + REST_S
    while True:
        traffic = probe.listen(0.02)
        counts = [frame.counts for frame in traffic.feedback.get(name, [])]
        if not counts or max(counts) - min(counts) <= STILL_COUNTS or probe.now() >= end:
            return traffic


def _build_trace(traffic: Traffic, name: str, start: int, is_stamped: bool) -> Trace:
    """Build the trace; `is_stamped` is whether the deflection has the timestamps of the bus, like
    the feedback.
    """
    heard = traffic.feedback.get(name, [])
    if not (heard and traffic.deflection):
        return NO_TRACE
    times = np.array([frame.stamp_s if is_stamped else frame.time_s for frame in heard])
    # The latest reading at that time: between two readings the counts are unknown.
    later = np.searchsorted([reading.time_s for reading in traffic.deflection], times, "right")
    counts = np.array([float(reading.counts) for reading in traffic.deflection])
    deflected = counts[np.maximum(later - 1, 0)]
    moved = np.array([float(frame.counts - start) for frame in heard])
    current = np.array([float(frame.current_ma) for frame in heard])
    return Trace(times - times[0], moved, deflected, current)


def _find_travel(traffic: Traffic, name: str, start: int, spring: int) -> tuple[int, int]:
    """The largest change so far of the motor's counts and of the deflection's."""
    heard = [frame.counts for frame in traffic.feedback.get(name, [])]
    moved = max((counts - start for counts in heard), key=abs, default=0)
    return moved, max((counts - spring for counts, _ in traffic.deflection), key=abs, default=0)
