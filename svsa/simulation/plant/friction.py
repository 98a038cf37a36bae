"""Friction of the motors: Coulomb and Stribeck."""

from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp, tanh


@compiled
def compute_friction(
    velocity: float, coulomb: float, static: float, stribeck: float, creep: float
) -> float:
    """τ_f = [τ_c + (τ_s − τ_c) e^(−(v/v_s)²)] tanh(v/v_c), N·m, against the motion.

    velocity v: rad/s. coulomb τ_c, static τ_s: N·m. stribeck v_s: rad/s, > 0. creep v_c:
    rad/s, > 0, the velocity at which a motor that should stick creeps; the tanh stands for
    the sign, so that the equations stay differentiable.
    """
    ratio = velocity / stribeck
    level = coulomb + (static - coulomb) * exp(-ratio * ratio)
    return level * tanh(velocity / creep)
