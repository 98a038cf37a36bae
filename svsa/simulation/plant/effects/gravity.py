"""The weight of the link itself."""

from typing import Any

from svsa.actuators.dynamics import ExternalLoad
from svsa.actuators.signals import State
from svsa.inputs.checked import Checked, Number, quantity
from svsa.numerics.compilation import compiled
from svsa.simulation.plant.effects.effect import Effect, Surroundings


class LinkGravity(Checked):
    """The weight of the link itself: τ_g = moment · sin q."""

    moment_nm: Number = quantity(
        "N·m", "m g r of the link", symbol="Moment m g r", ge=0, le=50, default=0.5
    )


def _build(gravity: LinkGravity, _: Surroundings) -> float:
    return gravity.moment_nm


@compiled
def add_weight(effects: Any, x: State, load: ExternalLoad) -> ExternalLoad:
    """The load with the moment of the link's weight, N·m; the dynamics multiply it by sin q."""
    moment = load.gravity_moment + effects.gravity
    return ExternalLoad(load.w2, load.w4, load.w6, load.inertia, moment)


EFFECT = Effect(
    name="gravity",
    place=60,
    kind=LinkGravity | None,
    field=quantity("", "Weight of the link", default=None),
    words="link weight",
    preset="full",
    on=LinkGravity(),
    phrase="the weight of the link",
    off=0.0,
    build=_build,
    resist=add_weight,
)
