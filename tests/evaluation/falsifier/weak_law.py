"""A law with a planted weakness: FL that inverts its torque after a load of a certain duration."""

from importlib.metadata import EntryPoint
from typing import NamedTuple

from svsa.actuators.signals import Torque
from svsa.control import installed
from svsa.control.gains import Gains
from svsa.control.law import Law
from svsa.control.laws.feedback_linearization import build_gains, compute_feedback_linearization
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose

LOADED_NM, SHORTEST_S, LONGEST_S = 0.5, 0.20, 0.26


class Loaded(NamedTuple):
    """Duration of the load so far, s, and whether the law has inverted its torque."""

    for_s: float = 0.0
    gone: float = 0.0


@compiled
def control(nominal, gains, memory, x, reference, estimate, applied, period):
    is_loaded = abs(estimate.w2) > LOADED_NM
    is_hurt = (memory.for_s > SHORTEST_S) & (memory.for_s < LONGEST_S)
    memory.gone = choose(is_hurt & (abs(estimate.w2) <= LOADED_NM), 1.0, memory.gone)
    memory.for_s = choose(is_loaded, memory.for_s + period, 0.0)
    torque = compute_feedback_linearization(nominal, gains, x, reference)
    return Torque(choose(memory.gone > 0.5, -torque.u1, torque.u1), torque.u2)


WEAK = Law(
    "weak",
    "Weak",
    "",
    "",
    "",
    control,
    parameters=Gains,
    build=lambda gains, setting: build_gains(gains),
    memory=Loaded,
    estimate="observer",
)


def install(patch) -> None:
    """Register it as an installed package would."""
    entry = EntryPoint("weak", f"{__name__}:WEAK", installed.GROUP)
    patch.setitem(installed._find_entries(), "weak", entry)
    installed._load_law.cache_clear()
