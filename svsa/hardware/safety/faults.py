"""What ends a run on a bench: each fault, and within which time its current is zero."""

from typing import Any, NamedTuple

from svsa.actuators.domain import FAULT_CODES


class FaultKind(NamedTuple):
    """What happened, and the longest time from the cause to zero current on the wire, s."""

    meaning: str
    within_s: float


_TICK_S = 0.002
_SUPERVISOR_S = 0.030
_THIRD_LINE_S = 0.25

FAULTS: dict[str, FaultKind] = {
    "quick_stop": FaultKind("somebody pressed the quick stop", _TICK_S),
    "not_finite": FaultKind("a torque or a state was not a finite number", _TICK_S),
    "stale_feedback": FaultKind("an encoder has not been heard of for 20 ms", 0.007),
    "missed_ticks": FaultKind("the loop missed 20 ticks in a row", 0.022),
    "loop_late": FaultKind(
        "the loop was late by over 20 ms: the supervisor has stopped the drives", _SUPERVISOR_S
    ),
    "loop_silent": FaultKind(
        "the loop's process stands still: the supervisor has stopped the drives", _SUPERVISOR_S
    ),
    "loop_lost": FaultKind(
        "the loop's process has ended: the supervisor has stopped the drives", _SUPERVISOR_S
    ),
    "loop_and_supervisor_lost": FaultKind(
        "both processes have ended: the server has opened the bus and stopped the drives",
        _THIRD_LINE_S,
    ),
    "drive_error": FaultKind("a drive sent an error frame (stall protection)", 0.102),
    "drive_zeroed": FaultKind("a drive's position jumped to zero: it restarted", 0.004),
    "drive_silent": FaultKind("a drive did not answer while it was brought to READY", 2.0),
    "bus_error": FaultKind("the bus reported an error, or is gone", _TICK_S),
    "foreign_command": FaultKind(
        "somebody else gave the drives a command: another program on the bus", _TICK_S
    ),
    "encoder_lost": FaultKind("the deflection encoder's source failed", _TICK_S),
    "overspeed": FaultKind("a motor or the link was faster than allowed", _TICK_S),
    "position_limit": FaultKind("an axis went beyond its end by more than the margin", _TICK_S),
    "overload": FaultKind("a motor was too warm for too long (I²t)", _TICK_S),
    "implausible": FaultKind(
        "the observer sees a torque that no load makes: an encoder or motor is wrong", _TICK_S
    ),
    "encoder_frozen": FaultKind(
        "an encoder stands still while the torque on its axis changes by over 1 N·m", _TICK_S
    ),
    "vibration": FaultKind("a motor shakes: ten reversals within 0.5 s", 0.502),
    "supervisor_lost": FaultKind("the supervisor has not been heard of for 0.05 s", 0.055),
    **{
        code: FaultKind("the actuator left the domain of the model", _TICK_S)
        for code in FAULT_CODES.values()
        if code != "not_finite"
    },
}


class Alarm(NamedTuple):
    """A fault that was found: its code of `FAULTS`, in words, and the values in it."""

    code: str
    message: str
    values: dict[str, Any]
