"""The table of faults: everything that ends a run early, in a simulation or on a bench.

Each fault is defined here once, with code, label, cause and remedy. The compiled domain check, the
supervision of a bench, the server, the page and the records all use this table.
"""

from collections.abc import Mapping
from typing import Any, Literal, NamedTuple

_TICK_S = 0.002
_SUPERVISOR_S = 0.030
_THIRD_LINE_S = 0.25

ALLOWED_TORQUE = "_allowed_nm"
"""Suffix of the name of a fault's value: the torque to which heat limited a motor, N·m."""
_FORMER_ALLOWED = "_held_to_nm"
"""The same in records of 0.1.0."""


class FaultKind(NamedTuple):
    """One row of the table.

    Attributes:
        label: A few words for marks and tables.
        cause: What happened, as a clause.
        advice: What to check or try next.
        number: Number of the fault in compiled code; None if compiled code does not report it.
        where: Whether it can end a run on a bench, a simulated run, or both.
        within_s: Longest time from the cause to zero current on the wire, s; None if no current can
            flow.
        is_loss: Whether the server reports it because the loop of a bench cannot report.
    """

    label: str
    cause: str
    advice: str
    number: int | None = None
    where: Literal["bench", "both"] = "bench"
    within_s: float | None = _TICK_S
    is_loss: bool = False


_CHECK_COMPUTER = (
    "The computer is too slow or too busy. End other programs, and allow real-time priority and"
    " locked memory for the lab (see Details, Control loop)."
)
_READ_LOG = "Read the reason in the log of the lab. Then press Restart loop."

FAULTS: dict[str, FaultKind] = {
    "not_finite": FaultKind(
        "Not a finite number",
        "a torque or a state was not a finite number",
        "The gains or bandwidths are too high for the control rate, and the loop is unstable. Undo"
        " the last changes, or place slower poles (Place poles).",
        number=1,
        where="both",
    ),
    "lever_end": FaultKind(
        "End of stiffness range",
        "the lever ratio μ (of other actuators the stiffness coordinate s) left its range",
        "A load deflects a soft spring far. To keep the stiffness, the control law then moves"
        " the stiffness motor far and fast. Whether the end is reached depends on the onset time"
        " of the load. A torque on the stiffness motor can have the same effect. Try a stiffer"
        " setting, a smaller load, a slower motion, slower stiffness poles and observer (Place"
        " poles), or a control law that reduces its bandwidth while the torque saturates (NDOBC-W,"
        " NDOBC-S).",
        number=2,
        where="both",
    ),
    "deflection_limit": FaultKind(
        "Deflection too large",
        "the deflection φ reached its limit, shortly before the stiffness becomes zero",
        "Beyond this angle the stiffness of the spring is negative, and no control law can bring"
        " the link back. Try a stiffer setting, a smaller load, a slower motion, or a control law"
        " that reduces its bandwidth while the torque saturates (NDOBC-W, NDOBC-S).",
        number=3,
        where="both",
    ),
    "singular_decoupling": FaultKind(
        "Decoupling near singular",
        "the matrix A(x), which a control law inverts, became nearly singular",
        "If a soft spring is deflected far, both motors have nearly the same effect. To control"
        " position and stiffness separately would take more torque than the motors have. Try a"
        " stiffer setting, a smaller load or a slower motion.",
        number=4,
        where="both",
    ),
    "quick_stop": FaultKind(
        "Quick stop",
        "a user pressed the quick stop",
        "Make sure that the link cannot hit a person. Then clear the fault and arm the bench.",
    ),
    "stale_feedback": FaultKind(
        "Feedback too old",
        "an encoder has sent nothing for 20 ms",
        "Check plug, cable and supply of this encoder or drive, and that no other program loads bus"
        " or computer.",
        within_s=0.007,
    ),
    "missed_ticks": FaultKind(
        "Ticks missed", "the loop missed 20 ticks in a row", _CHECK_COMPUTER, within_s=0.022
    ),
    "loop_late": FaultKind(
        "Control loop late",
        "the loop was late by over 20 ms: the supervisor has stopped the drives",
        _CHECK_COMPUTER,
        within_s=_SUPERVISOR_S,
    ),
    "loop_silent": FaultKind(
        "Control loop silent",
        "the loop's process does not tick: the supervisor has stopped the drives",
        _READ_LOG,
        within_s=_SUPERVISOR_S,
        is_loss=True,
    ),
    "loop_lost": FaultKind(
        "Control loop lost",
        "the loop's process has ended: the supervisor has stopped the drives",
        _READ_LOG,
        within_s=_SUPERVISOR_S,
        is_loss=True,
    ),
    "loop_and_supervisor_lost": FaultKind(
        "Loop and supervisor lost",
        "both processes have ended: the server has opened the bus and stopped the drives",
        _READ_LOG,
        within_s=_THIRD_LINE_S,
        is_loss=True,
    ),
    "bench_not_opened": FaultKind(
        "Bench not opened",
        "the bus or the processes of the bench did not start",
        "Fix the cause in the message. Then press Restart loop.",
        within_s=None,
        is_loss=True,
    ),
    "drive_error": FaultKind(
        "Drive error",
        "a drive sent an error frame (stall protection)",
        "Check that the mechanism turns freely, and the leads of the motor. Switch the drive off"
        " and on.",
        within_s=0.102,
    ),
    "drive_zeroed": FaultKind(
        "Drive restarted",
        "a drive's position jumped to zero: it restarted",
        "Check the supply of the drive: its voltage may drop under load or rise during braking.",
        within_s=0.004,
    ),
    "drive_silent": FaultKind(
        "Drive silent",
        "a drive did not answer while it was brought to READY",
        "Stop the lab, and run `svsa bench-check`: it tests bus and drives step by step.",
        within_s=2.0,
    ),
    "bus_error": FaultKind(
        "Bus error",
        "the bus reported an error, or is lost",
        "Check adapter, plugs, ground, 120 Ω at both ends, and the bit rate of all nodes.",
    ),
    "foreign_command": FaultKind(
        "Foreign command",
        "another program on the bus sent the drives a command",
        "End the other program, or disconnect the other node from the bus.",
    ),
    "encoder_lost": FaultKind(
        "Encoder lost",
        "the source of the deflection encoder failed",
        "Check plug, cable and supply of the deflection encoder, and its port or card.",
    ),
    "overspeed": FaultKind(
        "Too fast",
        "a motor or the link was faster than its limit",
        "A motor or the link turned faster than the bench file allows. Try a smaller or slower"
        " motion or load, and slower poles and observer (Place poles).",
    ),
    "position_limit": FaultKind(
        "Beyond its end",
        "an axis passed its end by more than the margin",
        "Check the zero marks, and the position limits in the bench file. Try a smaller motion or a"
        " smaller load.",
    ),
    "overload": FaultKind(
        "Motor overloaded",
        "a motor was too warm for too long (I²t)",
        "Let the motor cool. Then try a smaller or slower motion, or a smaller load: the current"
        " was above the continuous current of the motor.",
    ),
    "implausible": FaultKind(
        "Implausible torque",
        "the observer estimates a torque that no load causes: an encoder or motor is wrong",
        "Check signs and scales with `svsa bench-check --move`. A load above disturbance_max_nm in"
        " the bench file has the same effect.",
    ),
    "encoder_frozen": FaultKind(
        "Encoder frozen",
        "an encoder does not change while the torque on its axis changes by over 1 N·m",
        "Check plug and supply of the encoder, and that the axis turns freely.",
    ),
    "vibration": FaultKind(
        "Vibration",
        "a motor oscillates: ten reversals within 0.5 s",
        "The poles or the observer are too fast for the encoders and the drives. Try slower ones"
        " (Place poles).",
        within_s=0.502,
    ),
    "supervisor_lost": FaultKind(
        "Supervisor lost",
        "the supervisor has sent nothing for 0.05 s",
        "The computer is too busy, or the supervisor has ended. " + _READ_LOG,
        within_s=0.055,
    ),
}

FAULT_CODES: dict[int, str] = {
    kind.number: code for code, kind in FAULTS.items() if kind.number is not None
}
"""The code of each number that compiled code reports."""

BENCH_FAULTS: dict[str, float] = {
    code: kind.within_s for code, kind in FAULTS.items() if kind.within_s is not None
}
"""For each fault that sets an armed bench to zero current: the maximum time it takes, s."""

LOSSES: tuple[str, ...] = tuple(code for code, kind in FAULTS.items() if kind.is_loss)
"""The codes of a bench whose loop does not tick."""

_HEAT_ADVICE = (
    "From 90 % of the rated heat of its winding (I²t) on, a motor produces less torque than the"
    " control law commands, so that the winding is not damaged. The remaining torque did not hold"
    " the load, and the actuator moved to the position in the fault. Other gains and control laws"
    " do not help. Let the motor cool (its heat is under Details), then try a load that needs less"
    " torque of that motor, or remove the load earlier."
)


def find_number(code: str) -> int:
    """Return the number of a fault in compiled code.

    Raises:
        LookupError: If compiled code does not report this fault.
    """
    number = FAULTS[code].number
    if number is None:
        raise LookupError(code)
    return number


def label_fault(code: str) -> str:
    """Return the label of a fault; an unknown code (of a newer record) with blanks for
    underscores.
    """
    kind = FAULTS.get(code)
    return kind.label if kind else code.replace("_", " ").capitalize()


def advise(code: str, values: Mapping[str, Any]) -> str | None:
    """Return the advice after a fault.

    Args:
        code: Code of the fault.
        values: Values of the fault. If heat limited a motor, that is the reason, whatever the code.

    Returns:
        A few sentences; None for an unknown code (of a newer record).
    """
    if any(name.endswith((ALLOWED_TORQUE, _FORMER_ALLOWED)) for name in values):
        return _HEAT_ADVICE
    kind = FAULTS.get(code)
    return kind.advice if kind else None
