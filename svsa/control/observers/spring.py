"""The spring estimator: the spring constant from motor 1, without link, load or gravity.

The second row of Eq 1 contains no quantity of the link:

    τ_e = B1 θ̈1 + D1 θ̇1 + τ_f(θ̇1) − u1

With the nominal spring torque τ_n(φ, μ) and κ = K/K_n it is linear in five unknowns z,

    B1n θ̈1 + D1n θ̇1 − u1 − τ_n = (κ − 1) τ_n − δ_B B1n θ̈1 − δ_D D1n θ̇1 − f tanh(θ̇1/v) − o

Both sides pass the filter ω²/(s + ω)², so that measured positions are enough. A Kalman filter with
one sample per filter time 1/ω estimates z from a prior of zero. κ is constant except for a slow
drift; what the samples say of the others is forgotten, because friction, offset and what stands for
them change with the motion. Without excitation the deviation of κ stays that of its prior: motion
without a load says little about the spring.

A scale error of the torque is a scale error of κ; its deviation is added to that of κ. Another
shape of the spring shows in the innovations: if the mean of their normalised squares exceeds a
limit, no estimate is given until the estimator is started again. For an actuator with an elastic
energy κ is the factor of its torque, with the nominal shape.

G. Grioli and A. Bicchi, "A non-invasive, real-time method for measuring variable stiffness",
Robotics: Science and Systems VI, 2010, and F. Flacco, A. De Luca, I. Sardellitti and N. G.
Tsagarakis, "On-line estimation of variable stiffness in flexible robot joints", Int. J. Robotics
Research 31(13), 2012, estimate the stiffness itself; here the known shape leaves one constant.
"""

import math
from typing import NamedTuple

import numpy as np

from svsa.actuators.elasticity import (
    Actuator,
    compute_coordinate,
    compute_stiffness_of,
    compute_torques,
)
from svsa.actuators.signals import Positions
from svsa.inputs.checked import Checked, Flag, Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp, tanh

UNKNOWNS, SIGNALS = 5, 5
SETTLING = 8
"""Filter times after a start that are not used: the transient of both filters is then 0.3 %."""
MISFIT_S = 1.0
"""Time over which squared innovations are averaged, s."""
DEFLECTION_S, FRICTION_S = 0.8, 0.2
"""Times for which the errors of a deflection at rest, and of the friction at standstill, persist:
each sample in such a time has the variance of all of them.
"""
MOVING = 0.1
"""Share of the variance of a deflection that is left while it passes many counts of its encoder."""


class SpringEstimation(Checked):
    """Prior, noise and forgetting of the spring estimator. Standard deviations are of one sigma."""

    is_on: Flag = quantity("", "Whether the estimator is on", symbol="On", default=True)
    spring_deviation: Number = quantity(
        "1", "Prior deviation of K/K_n", symbol="Spring, prior", gt=0, le=1, default=0.4
    )
    inertia_deviation: Number = quantity(
        "1", "Prior relative deviation of B1", symbol="Inertia, prior", gt=0, le=1, default=0.25
    )
    damping_deviation: Number = quantity(
        "1", "Prior relative deviation of D1", symbol="Damping, prior", gt=0, le=2, default=0.5
    )
    friction_deviation_nm: Number = quantity(
        "N·m", "Prior deviation of the Coulomb friction of motor 1", symbol="Friction, prior",
        gt=0, le=50, default=0.3,
    )  # fmt: skip
    offset_deviation_nm: Number = quantity(
        "N·m", "Prior deviation of a constant torque on motor 1", symbol="Offset, prior",
        gt=0, le=50, default=0.2,
    )  # fmt: skip
    scale_deviation: Number = quantity(
        "1", "Deviation of torque constant and gear efficiency: no measurement here reduces it",
        symbol="Torque scale", ge=0, le=0.2, default=0.002,
    )  # fmt: skip
    noise_nm: Number = quantity(
        "N·m", "Deviation of a filtered sample of the torque balance", symbol="Noise",
        gt=0, le=5, default=0.005,
    )  # fmt: skip
    deflection_noise_rad: Number = quantity(
        "rad", "Deviation of a filtered deflection: times σ, it adds to the noise",
        symbol="Deflection noise", ge=0, le=0.1, default=0.0002,
    )  # fmt: skip
    filter_rad_per_s: Number = quantity(
        "rad/s", "Corner ω of the filters, one sample per 1/ω: faster follows more of the noise",
        symbol="Filter ω", ge=2, le=100, default=60.0,
    )  # fmt: skip
    forgetting_s: Number = quantity(
        "s", "Time in which all unknowns but the spring return to their prior",
        symbol="Forgetting", ge=0.1, le=600, default=2.0,
    )  # fmt: skip
    drift_per_sqrt_s: Number = quantity(
        "1/√s", "Drift of K/K_n, as deviation after one second: a spring changes slowly",
        symbol="Drift", ge=0, le=0.1, default=0.0005,
    )  # fmt: skip
    slip_rad_per_s: Number = quantity(
        "rad/s", "Velocity v at which the friction reaches 76 % of its value", symbol="Slip v",
        gt=0, le=1, default=0.02,
    )  # fmt: skip
    misfit_limit: Number = quantity(
        "1", "Largest mean of squared normalised innovations: above it the shape is another one",
        symbol="Misfit limit", gt=1, le=100, default=2.0,
    )  # fmt: skip

    def build(self, period: float) -> "SpringConstants":
        """Build the constants of the compiled estimator.

        Args:
            period: Control period T, s.

        Returns:
            Constants for this period; `OFF` if it is not on.
        """
        if not self.is_on:
            return OFF
        every = max(1, round(1.0 / (self.filter_rad_per_s * period)))
        step = every * period
        return SpringConstants(
            every=float(every),
            share=1.0 - exp(-self.filter_rad_per_s * period),
            kept=exp(-step / self.forgetting_s),
            drift=self.drift_per_sqrt_s**2 * step,
            prior=(
                self.spring_deviation**2,
                self.inertia_deviation**2,
                self.damping_deviation**2,
                self.friction_deviation_nm**2,
                self.offset_deviation_nm**2,
            ),
            scale=self.scale_deviation**2,
            noise=self.noise_nm**2,
            deflection=self.deflection_noise_rad**2,
            at_rest=DEFLECTION_S / step,
            at_standstill=FRICTION_S / step,
            slip=1.0 / self.slip_rad_per_s,
            share_of_misfit=1.0 - exp(-step / MISFIT_S),
            misfit=self.misfit_limit,
        )


class SpringConstants(NamedTuple):
    """Constants of the compiled estimator.

    Attributes:
        every: Periods per sample; 0 if the estimator is off.
        share: 1 − e^(−ωT) of the filters.
        kept: Share of the information about the other unknowns that is left after one sample.
        drift: Variance that κ gains per sample.
        prior: Prior variances of z.
        scale: Variance of the torque scale.
        noise: Variance of a sample, (N·m)².
        deflection: Variance of a deflection, rad².
        at_rest: Factor of that variance while the deflection stands.
        at_standstill: Factor of the variance of the friction at standstill.
        slip: 1/v, s/rad.
        share_of_misfit: Share of a new squared innovation in its mean.
        misfit: Largest mean of squared normalised innovations.
    """

    every: float
    share: float
    kept: float
    drift: float
    prior: tuple[float, float, float, float, float]
    scale: float
    noise: float
    deflection: float
    at_rest: float
    at_standstill: float
    slip: float
    share_of_misfit: float
    misfit: float


OFF = SpringConstants(
    0.0, 0.0, 0.0, 0.0, (0.0, 0.0, 0.0, 0.0, 0.0), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
)


class Spring(NamedTuple):
    """State of the estimator.

    A filtered signal is a tuple: velocity θ̇1, spring torque, slip tanh(θ̇1/v), standstill 1 − slip²,
    and torque u1.

    Attributes:
        periods: Periods since the start of the filters.
        samples: Samples used; 0 before the first.
        theta1: Measured θ1 of the last period, rad.
        torque: Nominal spring torque of the last period, N·m.
        slip: tanh(θ̇1/v) of the last period.
        once: Signals after the first filter.
        twice: Signals after the second filter.
        acceleration: θ̈1 after both, rad/s².
        sampled: Filtered spring torque of the last sample, N·m.
        z: Estimated unknowns.
        P: Their covariance, row by row.
        Ph: Their covariance with the last sample, N·m.
        misfit: Mean of the squared normalised innovations.
        is_refused: 1 after the misfit has exceeded its limit.
    """

    periods: float = 0.0
    samples: float = 0.0
    theta1: float = 0.0
    torque: float = 0.0
    slip: float = 0.0
    once: tuple[float, ...] = (0.0,) * SIGNALS
    twice: tuple[float, ...] = (0.0,) * SIGNALS
    acceleration: float = 0.0
    sampled: float = 0.0
    z: tuple[float, ...] = (0.0,) * UNKNOWNS
    P: tuple[float, ...] = (0.0,) * (UNKNOWNS * UNKNOWNS)
    Ph: tuple[float, ...] = (0.0,) * UNKNOWNS
    misfit: float = 1.0
    is_refused: float = 0.0


class SpringEstimate(NamedTuple):
    """What the estimator knows; κ and its deviation are NaN after a misfit.

    Attributes:
        ratio: κ = K/K_n.
        deviation: Standard deviation of κ, with that of the torque scale.
        misfit: Root of the mean of the squared normalised innovations: about 1 if the model holds.
    """

    ratio: float
    deviation: float
    misfit: float


NO_ESTIMATE = SpringEstimate(0.0, 0.0, 0.0)
"""While the estimator is off."""


@compiled
def update_spring(
    constants: SpringConstants,
    spring: np.record,
    nominal: Actuator,
    measured: Positions,
    dtheta1: float,
    u1: float,
    period: float,
) -> None:
    """Update the estimate by one period.

    Args:
        constants: `SpringConstants`, on.
        spring: State of the estimator (`Spring`), written.
        nominal: Constants of the nominal model.
        measured: Measured positions at the end of the period, rad.
        dtheta1: Estimated velocity of motor 1 there, rad/s, for the friction.
        u1: Mean torque of motor 1 in the period, N·m, positive in the direction of growing θ1.
        period: Control period T, s.
    """
    k = constants
    s, phi = compute_coordinate(nominal, measured.theta2), measured.q - measured.theta1
    torque, slip = compute_torques(nominal, s, phi).torque, tanh(k.slip * dtheta1)
    if spring.samples == 0.0 and spring.periods == 0.0:
        _start_spring(k, spring)
    if spring.periods == 0.0:
        spring.acceleration = 0.0
        still = (dtheta1, torque, slip, 1.0 - slip * slip, u1)
        for i in range(SIGNALS):
            spring.once[i] = spring.twice[i] = still[i]
    else:
        # Means over the period. The second filter has those over the last two halves of periods, at
        # which the difference of the velocities is the acceleration.
        mean = 0.5 * (spring.slip + slip)
        velocity, before = (measured.theta1 - spring.theta1) / period, spring.once[0]
        inputs = (velocity, 0.5 * (spring.torque + torque), mean, 1.0 - mean * mean, u1)
        for i in range(SIGNALS):
            old = spring.once[i]
            spring.once[i] = old + k.share * (inputs[i] - old)
            spring.twice[i] += k.share * (0.5 * (old + spring.once[i]) - spring.twice[i])
        rate = (spring.once[0] - before) / period
        spring.acceleration += k.share * (rate - spring.acceleration)
    spring.theta1, spring.torque, spring.slip = measured.theta1, torque, slip
    spring.periods += 1.0
    if spring.periods >= SETTLING * k.every and spring.periods % k.every == 0.0:
        _sample_spring(k, spring, nominal, compute_stiffness_of(nominal, s, phi))


@compiled
def _start_spring(constants: SpringConstants, spring: np.record) -> None:
    """Set the estimate to its prior."""
    for i in range(UNKNOWNS):
        spring.z[i] = 0.0
        for j in range(UNKNOWNS):
            spring.P[i * UNKNOWNS + j] = constants.prior[i] if i == j else 0.0


@compiled
def _sample_spring(
    constants: SpringConstants, spring: np.record, nominal: Actuator, sigma: float
) -> None:
    """One step of the Kalman filter, from the filtered signals; sigma: nominal stiffness."""
    k, n, z, P, Ph = constants, UNKNOWNS, spring.z, spring.P, spring.Ph
    acceleration, velocity, torque = spring.acceleration, spring.twice[0], spring.twice[1]
    slip, standstill, u1 = spring.twice[2], spring.twice[3], spring.twice[4]
    h = (torque, -nominal.B1 * acceleration, -nominal.D1 * velocity, -slip, -1.0)
    y = nominal.B1 * acceleration + nominal.D1 * velocity - u1 - torque
    # Of an unknown whose share r of the prior variance is left, the information of the samples is
    # multiplied by `kept`: r becomes r/(kept (1 − r) + r), and z moves to its prior accordingly.
    for i in range(1, n):
        r = P[i * n + i] / k.prior[i]
        growth = 1.0 / (k.kept * (1.0 - r) + r)
        z[i] *= k.kept * growth
        for j in range(n):
            P[i * n + j] *= math.sqrt(growth)
            P[j * n + i] *= math.sqrt(growth)
    P[0] += k.drift
    # At standstill the friction has any value up to that of motion.
    friction = k.at_standstill * standstill * standstill * (P[3 * n + 3] + z[3] * z[3])
    # A deflection that stands keeps the error of its encoder.
    change = torque - spring.sampled
    spring.sampled = torque
    deflection = k.deflection * sigma * sigma
    deflection *= MOVING + k.at_rest * deflection / (deflection + change * change)
    innovation, variance = y, k.noise + deflection + friction
    for i in range(n):
        innovation -= h[i] * z[i]
        total = 0.0
        for j in range(n):
            total += P[i * n + j] * h[j]
        Ph[i] = total
        variance += h[i] * total
    for i in range(n):
        z[i] += Ph[i] * innovation / variance
        for j in range(n):
            P[i * n + j] -= Ph[i] * Ph[j] / variance
    spring.misfit += k.share_of_misfit * (innovation * innovation / variance - spring.misfit)
    if spring.misfit > k.misfit:
        spring.is_refused = 1.0
    spring.samples += 1.0


@compiled
def read_spring(constants: SpringConstants, spring: np.record) -> SpringEstimate:
    """Read the estimate.

    Args:
        constants: `SpringConstants`, on.
        spring: `Spring`.

    Returns:
        κ, its standard deviation and the misfit; see `SpringEstimate`.
    """
    misfit = math.sqrt(spring.misfit)
    if spring.is_refused > 0.0:
        return SpringEstimate(math.nan, math.nan, misfit)
    ratio = 1.0 + spring.z[0]
    variance = constants.prior[0] if spring.samples == 0.0 else spring.P[0]
    return SpringEstimate(ratio, math.sqrt(variance + constants.scale * ratio * ratio), misfit)
