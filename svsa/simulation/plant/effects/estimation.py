"""Velocities that are not measured: x̂ from positions, see `svsa.control.observers.state`."""

from svsa.inputs.checked import Checked, Number, quantity
from svsa.simulation.plant.effects.effect import Effect


class StateEstimation(Checked):
    """Velocities (and positions) from measured positions, by predictor and corrector."""

    corner_rad_per_s: Number = quantity(
        "rad/s", "Bandwidth of the corrector", symbol="Corner", ge=1, le=2000, default=200.0
    )


EFFECT = Effect(
    name="estimation",
    place=20,
    kind=StateEstimation | None,
    field=quantity("", "State estimated from positions", default=None),
    words="estimated velocities",
    preset="rig",
    on=StateEstimation(),
    phrase="velocities estimated from them",
)
