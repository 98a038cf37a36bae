"""Causes of a bench's silent loop, and the process that stopped the drives."""

import math
from typing import Literal, NamedTuple

from svsa.hardware.realtime.launch import BenchProcesses

Stopper = Literal["supervisor", "server"]
SUPERVISED_S = 0.5
STOPPING_S = 0.1

_WHAT = {
    "loop_silent": "The control loop is stopped: its process runs, but does not tick.",
    "loop_lost": "The process of the control loop has ended.",
    "loop_and_supervisor_lost": "The processes of control loop and supervisor have both ended.",
}


class Loss(NamedTuple):
    """Loss of the loop.

    Attributes:
        code: Code in `svsa.actuators.faults.LOSSES`.
        message: Cause and action taken.
        stopped_by: The process that keeps the drives at zero current; None before that.
        problem: Why the server cannot do so.
    """

    code: str
    message: str
    stopped_by: Stopper | None
    problem: str | None


def is_supervised(processes: BenchProcesses) -> bool:
    """Whether the supervisor's process runs and its heartbeat is recent."""
    return processes.supervisor_alive and processes.beats.age_s("supervisor") < SUPERVISED_S


def find_loss(processes: BenchProcesses) -> Loss | None:
    """Return the loss that the server has detected; None while the loop ticks."""
    if processes.failure is not None:
        return Loss("bench_not_opened", f"{processes.failure} Restart the loop.", None, None)
    if processes.listens:
        return None
    intervention = processes.third_line.intervention
    after_s, problem = intervention or (None, None)
    code = "loop_silent" if processes.alive else "loop_lost"
    stopped_by: Stopper | None = None
    done = "The drives are not stopped yet: be ready to disconnect the motors' supply."
    ended_in_order = not processes.alive and math.isinf(processes.beats.age_s("loop"))
    both_gone = not (processes.alive or processes.supervisor_alive or ended_in_order)
    if intervention is not None or both_gone:
        code = "loop_and_supervisor_lost"
    if problem is not None:
        done = (
            "The server cannot reach the drives, which may hold their last current indefinitely:"
            f" disconnect the motors' supply. {problem}"
        )
    elif after_s is not None:
        stopped_by = "server"
        done = (
            f"The server has opened the bus itself, set both drives to zero current {after_s:.2f} s"
            " after the loop's last tick, and resets them."
        )
    elif ended_in_order:
        done = "It ended regularly and left both drives at zero current."
    elif processes.beats.age_s("stopping") < STOPPING_S:
        stopped_by = "supervisor"
        done = "The supervisor keeps both drives at zero current and resets them."
    words = f"{_WHAT[code]} {done} Restart the loop."
    return Loss(code, words, stopped_by, problem)
