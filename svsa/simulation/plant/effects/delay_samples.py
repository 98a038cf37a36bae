"""Delay of the torque by samples: the loop keeps a queue of limited torques."""

from svsa.inputs.checked import Whole, quantity
from svsa.simulation.plant.effects.effect import Effect, Surroundings

MAX_DELAY_SAMPLES = 5


def _build(samples: int, _: Surroundings) -> int:
    return samples


EFFECT = Effect(
    name="delay_samples",
    place=70,
    kind=Whole,
    field=quantity("samples", "Delay of the torque", ge=0, le=MAX_DELAY_SAMPLES, default=0),
    words="delay {}",
    preset="rig",
    on=1,
    phrase="torque one sample late",
    off=0,
    build=_build,
)
