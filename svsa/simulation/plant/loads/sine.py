"""A sinusoidal torque."""

import math
from collections.abc import Mapping
from typing import Any, ClassVar, Literal

import numpy as np

from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.memory import read
from svsa.numerics.trigonometry import sin
from svsa.simulation.plant.loads.load import A, B, TorqueLoad, format_torque


@compiled
def compute_wave(rows: np.ndarray, i: int, since: float) -> float:
    """sin(ωt + phase) at t = `since` (s); A of row i is ω, rad/s, and B the phase, rad."""
    return sin(read(rows, i, A) * since + read(rows, i, B))


class SineLoad(TorqueLoad):
    """torque · sin(2π f (t − onset) + phase)."""

    factor: ClassVar[Any] = staticmethod(compute_wave)
    first: ClassVar[Mapping[str, float] | None] = {"frequency_hz": 1.0}

    kind: Literal["sine"] = quantity("", "Sine", default="sine")
    frequency_hz: Number = quantity("Hz", "Frequency f", symbol="Frequency", gt=0, le=100)
    phase_rad: Number = quantity("rad", "Phase", ge=-2 * math.pi, le=2 * math.pi, default=0.0)

    def describe(self) -> str:
        """Describe the load by torque and frequency."""
        return f"sine {format_torque(self.torque_nm)} {self.frequency_hz:g} Hz"

    def fill(self, row: np.ndarray) -> None:
        """Write torque, angular frequency and phase into its row."""
        super().fill(row)
        row[A], row[B] = 2.0 * math.pi * self.frequency_hz, self.phase_rad
