"""Test whether this machine can isolate an untrusted law, by trying to break out."""

from functools import cache

from svsa.actuators.dynamics import Actuator
from svsa.actuators.signals import Disturbance, Positions, Reference, State, Torque
from svsa.teaching.isolation.confinement import Bounds
from svsa.teaching.isolation.process import LawProcess
from svsa.teaching.isolation.refusal import LawFaultError, NotIsolatedError

_MODEL = Actuator(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0)
_ESCAPES = b"""
import os, socket

def law(time_s, reference, x, w):
    ways = (
        lambda: os.listdir("/proc/1"),
        lambda: open("/etc/passwd"),
        lambda: open("/lab/child.py", "a"),
        lambda: socket.socket(),
        lambda: os.fork() or os._exit(0),
        lambda: os.kill(1, 0),
    )
    escaped = 0
    for way in ways:
        try:
            way()
        except OSError:
            continue
        escaped += 1
    return float(escaped), float(len(ways))
"""


@cache
def check_isolation() -> None:
    """Raise `NotIsolatedError` if one of six escape attempts succeeds; tested once a process."""
    zeros = Reference(*[0.0] * 8), State(*[0.0] * 6), Disturbance(0.0, 0.0, 0.0)
    still = Torque(0.0, 0.0), Positions(0.0, 0.0, 0.0)
    try:
        with LawProcess(_ESCAPES, _MODEL, Bounds(start_s=60.0)) as law:
            escaped, tried = law(0.0, *zeros, *still)
    except LawFaultError as error:
        reason = error.output.strip().split("\n")[-1] or str(error)
        raise NotIsolatedError(f"the sandbox does not start ({reason})") from None
    if escaped or not tried:
        raise NotIsolatedError(f"{escaped:.0f} of {tried:.0f} attempts to escape succeeded")


def find_isolation_problem() -> str | None:
    """Describe why this machine cannot isolate a law; None if it can."""
    try:
        check_isolation()
    except NotIsolatedError as error:
        return str(error)
    return None
