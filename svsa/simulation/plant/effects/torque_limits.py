"""Torque limits of the configuration, on by default."""

from svsa.inputs.checked import Flag, quantity
from svsa.simulation.plant.effects.effect import Effect

EFFECT = Effect(
    name="torque_limits",
    place=80,
    kind=Flag,
    field=quantity("", "Limits of the torques", default=True),
    words="no torque limits",
)
