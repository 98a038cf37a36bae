"""Conversion between the drives' integers and SI: torque and current, counts and angle."""

import math
from typing import NamedTuple

from svsa.hardware.bench.settings import DeflectionSettings, MotorSettings

MA_PER_A = 1000.0


class MotorScale(NamedTuple):
    """Scales of one motor: N·m at the gearbox output per mA, rad at the output per count."""

    torque_per_ma: float
    angle_per_count: float


def build_motor_scale(motor: MotorSettings) -> MotorScale:
    """τ = I N η K_t / 1000, θ = 2π counts / (counts per turn · N), both with the sign.

    Unknown values of the motor count as 1: such a bench cannot be armed.
    """
    ratio, sign = motor.gear_ratio or 1.0, motor.sign or 1
    constant, efficiency = motor.torque_constant_nm_per_a or 1.0, motor.efficiency or 1.0
    return MotorScale(
        sign * ratio * efficiency * constant / MA_PER_A,
        sign * 2.0 * math.pi / ((motor.counts_per_rev or 1) * ratio),
    )


def compute_current_ma(torque: float, scale: MotorScale) -> int:
    """I = 1000 τ / (N η K_t), whole mA, of a torque in N·m."""
    return round(torque / scale.torque_per_ma)


def build_deflection_scale(deflection: DeflectionSettings) -> float:
    """rad of φ for a count, with its sign."""
    return (deflection.sign or 1) * 2.0 * math.pi / (deflection.counts_per_rev or 1)


class Unwrapped:
    """A counter of `bits` bits, unwrapped.

    The first reading is interpreted as the possible value nearest to `start`.
    """

    def __init__(self, bits: int, start: int = 0) -> None:
        self._half, self._whole = 1 << (bits - 1), 1 << bits
        self._start = self.counts = start

    def update(self, raw: int) -> int:
        """Return the unwrapped count nearest to the last one."""
        self.counts += (raw - self.counts + self._half) % self._whole - self._half
        return self.counts

    def reset(self) -> None:
        """Restart at the initial count."""
        self.counts = self._start
