"""Forces on the plant from non-ideal effects."""

from typing import Any

from svsa.actuators.dynamics import ExternalLoad
from svsa.actuators.signals import State
from svsa.numerics.compilation import compiled, specialize
from svsa.simulation.plant.effects import EFFECTS, EffectConstants

before: Any = None
resist: Any = None
"""Specialises `_add_next`: the function for the previous effects, and this one's `resist`."""


@compiled
def _add_nothing(effects: EffectConstants, x: State, load: ExternalLoad) -> ExternalLoad:
    return load


def _add_next(effects: EffectConstants, x: State, load: ExternalLoad) -> ExternalLoad:
    return resist(effects, x, before(effects, x, load))


def _chain() -> Any:
    """Chain all of them in one compiled function without lists and function pointers."""
    add = _add_nothing
    for effect in EFFECTS:
        if effect.resist is not None:
            add = specialize(_add_next, f"add_{effect.name}", before=add, resist=effect.resist)
    return add


add_resistance = _chain()
"""(effects, x, load) -> `ExternalLoad`: the load of the table plus that of every effect."""
