"""Friction of the motors."""

from typing import Any, NamedTuple

from svsa.actuators.dynamics import ExternalLoad
from svsa.actuators.signals import State
from svsa.inputs.checked import Checked, Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp, tanh
from svsa.numerics.simd.choice import choose, some
from svsa.simulation.plant.effects.effect import Effect, Surroundings


class Friction(Checked):
    """Coulomb and Stribeck friction of both motors, at the gearbox outputs."""

    coulomb1_nm: Number = quantity(
        "N·m", "Coulomb friction of motor 1", symbol="Coulomb, motor 1", ge=0, le=50, default=0.2
    )
    coulomb2_nm: Number = quantity(
        "N·m", "Coulomb friction of motor 2", symbol="Coulomb, motor 2", ge=0, le=50, default=0.1
    )
    static_ratio: Number = quantity(
        "1",
        "Ratio of breakaway to Coulomb friction",
        symbol="Breakaway ratio",
        ge=1,
        le=5,
        default=1.3,
    )
    stribeck_rad_per_s: Number = quantity("rad/s", "Stribeck velocity", ge=1e-3, le=10, default=0.1)


class FrictionConstants(NamedTuple):
    """Constants of the friction of both motors.

    Attributes:
        coulomb1: Coulomb friction of motor 1, N·m; 0 for none. coulomb2 of motor 2.
        static1: Static friction of motor 1, N·m; static2 of motor 2.
        stribeck: Stribeck velocity, rad/s, > 0.
        creep1: Creep velocity of motor 1, rad/s, > 0; creep2 of motor 2.
    """

    coulomb1: float
    coulomb2: float
    static1: float
    static2: float
    stribeck: float
    creep1: float
    creep2: float


def _build(friction: Friction, surroundings: Surroundings) -> FrictionConstants:
    """Use the smallest creep velocity for which one Runge–Kutta step per period is stable.

    It is a tenth of the Stribeck velocity, or 2 τ_s T/B if that is larger.
    """
    plant, period_s = surroundings.actuator, surroundings.period_s
    coulomb1, coulomb2, ratio = friction.coulomb1_nm, friction.coulomb2_nm, friction.static_ratio
    stribeck = friction.stribeck_rad_per_s
    return FrictionConstants(
        coulomb1=coulomb1,
        coulomb2=coulomb2,
        static1=coulomb1 * ratio,
        static2=coulomb2 * ratio,
        stribeck=stribeck,
        creep1=max(0.1 * stribeck, 2.0 * coulomb1 * ratio * period_s / plant.motor1_inertia_kg_m2),
        creep2=max(0.1 * stribeck, 2.0 * coulomb2 * ratio * period_s / plant.motor2_inertia_kg_m2),
    )


@compiled
def compute_friction(
    velocity: float, coulomb: float, static: float, stribeck: float, creep: float
) -> float:
    """τ_f = [τ_c + (τ_s − τ_c) e^(−(v/v_s)²)] tanh(v/v_c), N·m, against the motion.

    The tanh replaces the sign, so that the equations stay differentiable: a motor that should stick
    moves with up to the creep velocity.

    Args:
        velocity: v, rad/s.
        coulomb: τ_c, N·m.
        static: τ_s, N·m.
        stribeck: v_s, rad/s, > 0.
        creep: v_c, rad/s, > 0.

    Returns:
        τ_f, N·m.
    """
    ratio = velocity / stribeck
    level = coulomb + (static - coulomb) * exp(-ratio * ratio)
    return level * tanh(velocity / creep)


@compiled
def resist_motion(effects: Any, x: State, load: ExternalLoad) -> ExternalLoad:
    """The load with the friction of both motors."""
    c, w4, w6 = effects.friction, load.w4, load.w6
    has_friction1, has_friction2 = c.static1 > 0.0, c.static2 > 0.0
    if some(has_friction1):
        friction = compute_friction(x.dtheta1, c.coulomb1, c.static1, c.stribeck, c.creep1)
        w4 = choose(has_friction1, w4 - friction, w4)
    if some(has_friction2):
        friction = compute_friction(x.dtheta2, c.coulomb2, c.static2, c.stribeck, c.creep2)
        w6 = choose(has_friction2, w6 - friction, w6)
    return ExternalLoad(load.w2, w4, w6, load.inertia, load.gravity_moment)


EFFECT = Effect(
    name="friction",
    place=30,
    kind=Friction | None,
    field=quantity("", "Motor friction", default=None),
    words="friction",
    preset="full",
    on=Friction(),
    phrase="friction",
    # In a batch the equations divide by these velocities even in runs without friction: no 0 here.
    off=FrictionConstants(0.0, 0.0, 0.0, 0.0, stribeck=1.0, creep1=0.1, creep2=0.1),
    build=_build,
    resist=resist_motion,
)
