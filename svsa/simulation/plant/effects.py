"""Effects: what separates the ideal simulation from a bench, one switch each.

Left out, an effect is off. Parameter error is the difference between the actuator and the
nominal model; a hung mass is a load.
"""

import math
from typing import Literal, NamedTuple

from svsa.actuators.parameters import ActuatorParameters
from svsa.inputs.checked import Checked, Flag, Number, Whole, quantity

MAX_DELAY_SAMPLES = 5


class Encoders(Checked):
    """Positions in whole counts: of both motors before their gearbox, and of the deflection."""

    motor_counts_per_rev: Whole = quantity("1", "Motor counts a turn", ge=4, le=10**7, default=2000)
    gear_ratio: Number = quantity("1", "Motor gearboxes N : 1", ge=1, le=1000, default=50.0)
    deflection_counts_per_rev: Whole = quantity(
        "1", "Deflection counts a turn", ge=4, le=10**8, default=8000
    )


class StateEstimation(Checked):
    """Velocities (and positions) from measured positions, by predictor and corrector."""

    corner_rad_per_s: Number = quantity(
        "rad/s", "Corner of the corrector", ge=1, le=2000, default=200.0
    )


class Friction(Checked):
    """Coulomb and Stribeck friction of both motors, at the gearbox outputs."""

    coulomb1_nm: Number = quantity("N·m", "Coulomb friction of motor 1", ge=0, le=50, default=0.2)
    coulomb2_nm: Number = quantity("N·m", "Coulomb friction of motor 2", ge=0, le=50, default=0.1)
    static_ratio: Number = quantity("1", "Breakaway over Coulomb", ge=1, le=5, default=1.3)
    stribeck_rad_per_s: Number = quantity("rad/s", "Stribeck velocity", ge=1e-3, le=10, default=0.1)


class CurrentLag(Checked):
    """The current loop of the drives as a first-order lag."""

    time_constant_s: Number = quantity("s", "Time constant", ge=1e-5, le=0.05, default=0.0005)


class SensorNoise(Checked):
    """White normal noise on the three measured angles, seeded by the run's seed."""

    motor_std_rad: Number = quantity(
        "rad", "Standard deviation, motors", ge=0, le=0.1, default=2e-5
    )
    deflection_std_rad: Number = quantity(
        "rad", "Standard deviation, deflection", ge=0, le=0.1, default=2e-4
    )


class LinkGravity(Checked):
    """The weight of the link itself: τ_g = moment · sin q."""

    moment_nm: Number = quantity("N·m", "m g r of the link", ge=0, le=50, default=0.5)


class Effects(Checked):
    """Everything that a bench has and an ideal simulation has not."""

    encoders: Encoders | None = quantity("", "Encoder quantisation", default=None)
    estimation: StateEstimation | None = quantity(
        "", "State estimated from positions", default=None
    )
    delay_samples: Whole = quantity(
        "samples", "From measurement to torque", ge=0, le=MAX_DELAY_SAMPLES, default=0
    )
    torque_limits: Flag = quantity("", "Torques limited as the limits say", default=True)
    friction: Friction | None = quantity("", "Motor friction", default=None)
    current_lag: CurrentLag | None = quantity("", "Lag of the current loop", default=None)
    noise: SensorNoise | None = quantity("", "Sensor noise", default=None)
    gravity: LinkGravity | None = quantity("", "Weight of the link", default=None)


IDEAL = Effects()
RIG = Effects(encoders=Encoders(), estimation=StateEstimation(), delay_samples=1)
EVERY = RIG.changed(
    friction=Friction(), current_lag=CurrentLag(), noise=SensorNoise(), gravity=LinkGravity()
)

PresetName = Literal["ideal", "rig", "full"]
PRESETS: dict[PresetName, Effects] = {"ideal": IDEAL, "rig": RIG, "full": EVERY}
"""Three choices among the effects, by name."""


def find_preset(effects: Effects) -> PresetName | None:
    """The preset that switches on the same effects, whatever their values; None for a mixture."""
    kind = _list_kinds(effects)
    return next((name for name, preset in PRESETS.items() if _list_kinds(preset) == kind), None)


def _list_kinds(effects: Effects) -> list[object]:
    """Of each effect whether it is on; of delay and torque limits the value."""
    return [
        value if isinstance(value, int) else value is not None
        for value in (getattr(effects, name) for name in Effects.model_fields)
    ]


class EffectConstants(NamedTuple):
    """The effects as constants of the compiled loop; 0 means off.

    motor_step, deflection_step: one count, rad at the gearbox output. motor_std,
    deflection_std: rad. delay: samples. lag: s. coulomb, static: N·m. stribeck, creep: rad/s.
    gravity_moment: N·m.
    """

    motor_step: float
    deflection_step: float
    motor_std: float
    deflection_std: float
    seed: int
    delay: int
    lag: float
    coulomb1: float
    coulomb2: float
    static1: float
    static2: float
    stribeck: float
    creep1: float
    creep2: float
    gravity_moment: float


def build_effect_constants(
    effects: Effects, seed: int, actuator: ActuatorParameters, period_s: float
) -> EffectConstants:
    """The constants of the effects that are on; without noise nothing is drawn of the seed.

    The creep velocity of friction is the least at which one Runge–Kutta step a period still
    settles: a tenth of the Stribeck velocity, or 2 τ_s T/B.
    """
    encoders, noise, friction = effects.encoders, effects.noise, effects.friction
    coulomb1 = friction.coulomb1_nm if friction else 0.0
    coulomb2 = friction.coulomb2_nm if friction else 0.0
    ratio = friction.static_ratio if friction else 1.0
    static1, static2 = coulomb1 * ratio, coulomb2 * ratio
    stribeck = friction.stribeck_rad_per_s if friction else 1.0
    turn = 2.0 * math.pi
    motor_counts = encoders.motor_counts_per_rev * encoders.gear_ratio if encoders else math.inf
    deflection_counts = encoders.deflection_counts_per_rev if encoders else math.inf
    return EffectConstants(
        motor_step=turn / motor_counts,
        deflection_step=turn / deflection_counts,
        motor_std=noise.motor_std_rad if noise else 0.0,
        deflection_std=noise.deflection_std_rad if noise else 0.0,
        # Without noise every seed gives 0, which a batch makes a literal: else each seed would
        # compile a batch again.
        seed=seed if noise else 0,
        delay=effects.delay_samples,
        lag=effects.current_lag.time_constant_s if effects.current_lag else 0.0,
        coulomb1=coulomb1,
        coulomb2=coulomb2,
        static1=static1,
        static2=static2,
        stribeck=stribeck,
        creep1=max(
            0.1 * stribeck, 2.0 * coulomb1 * ratio * period_s / actuator.motor1_inertia_kg_m2
        ),
        creep2=max(
            0.1 * stribeck, 2.0 * coulomb2 * ratio * period_s / actuator.motor2_inertia_kg_m2
        ),
        gravity_moment=effects.gravity.moment_nm if effects.gravity else 0.0,
    )
