"""Heat of a motor's winding (I²t): the torque that it allows, and its reduction."""

import math
from typing import NamedTuple

from svsa.hardware.bench.settings import AXIS_WORDS, MotorSettings
from svsa.hardware.drives.conversion import build_motor_scale
from svsa.numerics.exponential import expm1

WARM = 0.9
LINGERS_S = 0.5
"""Time for which a reduction by heat counts as a possible cause of later faults, s."""


def compute_lasting_torque(motor: MotorSettings) -> float:
    """The continuous torque at the output, N·m: that of the nominal current."""
    return motor.nominal_current_a * _compute_scale(motor)


def _compute_scale(motor: MotorSettings) -> float:
    """Compute the torque |τ| at the output for a current of 1 A, N·m."""
    return abs(build_motor_scale(motor).torque_per_ma) * 1000.0


class HeatReduction(NamedTuple):
    """A torque reduced by heat: available torque of the cold motor, and resulting torque, N·m."""

    commanded_nm: float
    allowed_nm: float


class Winding:
    """Heat h of one winding, 1 at its limit, and the torque that it permits.

    ḣ = ((τ/τ_n)² − h)/T and |τ| ≤ τ_n + (τ_p − τ_n) (1 − h)/(1 − 0.9) for 0.9 ≤ h ≤ 1, with the
    torques τ_n, τ_p of nominal and peak current: at τ_n, the continuous rating, heat stays at 1.

    `torque_max` is the design's limit, N·m; `scale` is the torque at the output for 1 A, N·m.
    """

    def __init__(self, motor: MotorSettings, torque_max: float) -> None:
        self.scale = _compute_scale(motor)
        self._peak = motor.peak_current_a * self.scale
        self._time_s = motor.thermal_time_s
        self.lasting_nm = compute_lasting_torque(motor)
        self.cold_nm = min(torque_max, self._peak)
        self.heat = 0.0

    def warm(self, torque: float, seconds: float) -> None:
        """Update the heat after this time with this torque, N·m (its rms if it varies)."""
        share = (torque / self.lasting_nm) ** 2
        # The exact solution for a constant torque, so that many missed ticks are one step.
        self.heat += -expm1(-seconds / self._time_s) * (share - self.heat)

    def allow(self) -> float:
        """Return the largest torque allowed now, N·m."""
        if self.heat <= WARM:
            return self.cold_nm
        room = max((1.0 - self.heat) / (1.0 - WARM), 0.0)
        return min(self.cold_nm, self.lasting_nm + room * (self._peak - self.lasting_nm))

    def find_heat_reduction(self, torque: float) -> HeatReduction | None:
        """Return the reduction of a commanded torque by heat, N·m; None without."""
        asked, allowed = min(abs(torque), self.cold_nm), self.allow()
        return HeatReduction(asked, allowed) if asked > allowed else None


class HeatReductionState:
    """Whether heat reduces a motor's torque, now or within the last half second."""

    def __init__(self) -> None:
        self._newest: HeatReduction | None = None
        self._since_s = math.inf

    @property
    def present(self) -> HeatReduction | None:
        """The latest reduced torque; None if it was longer ago."""
        return self._newest if self._since_s <= LINGERS_S else None

    def note(self, held: HeatReduction | None) -> None:
        """Note the reduction of the torque of this tick."""
        if held is not None:
            self._newest, self._since_s = held, 0.0

    def pass_time(self, seconds: float) -> None:
        """Advance the time."""
        self._since_s += seconds

    def forget(self) -> None:
        """Reset for a new run."""
        self._since_s = math.inf


def describe_heat_reduction(name: str, held: HeatReduction, winding: Winding) -> str:
    """Describe a reduction by heat, for the text of a later fault; `name` is that of the axis."""
    return (
        f"The torque of {AXIS_WORDS[name]} was limited by heat: its winding had"
        f" {100.0 * winding.heat:.0f} % of its heat limit. The torque was limited to"
        f" {held.allowed_nm:.3g} N·m, and {held.commanded_nm:.3g} N·m were commanded (continuous"
        f" rating: {winding.lasting_nm:.3g} N·m)."
    )


def describe_heat(name: str, is_on: bool) -> str:
    """Describe the start or the end of a reduction by heat, as an event."""
    return f"Torque of {AXIS_WORDS[name]} {'' if is_on else 'no longer '}limited by heat"
