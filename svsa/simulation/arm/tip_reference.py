"""References of the tip: an ellipse, or a movement from point to point; four derivatives."""

import math
from typing import Annotated, Literal, NamedTuple, Self, TypeAlias

from pydantic import Field, model_validator

from svsa.actuators.arm.parameters import ArmParameters
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import BY_KIND, Checked, Number, quantity
from svsa.simulation.reference.curve import build_curve
from svsa.simulation.reference.kinds.sine import build_sine
from svsa.simulation.reference.shape import Shape, build_curve_shape

Elbow = Literal["positive", "negative"]
_Coordinate = Annotated[Number, Field(ge=-6, le=6)]
XY = "(x horizontal, y up) from joint 1"
MARGIN = 0.02
"""How near to the straight and to the folded arm a tip may come, as a share of l1 + l2."""


class Path(NamedTuple):
    """Both coordinates of a tip, m."""

    x: Shape
    y: Shape


class AnyTipReference(Checked):
    """A reference of the tip of two links, which replaces the references of both joints."""

    elbow: Elbow = quantity("", "Sign of q2", default="positive")

    @property
    def sign(self) -> float:
        """Sign of q2."""
        return 1.0 if self.elbow == "positive" else -1.0

    def build_path(self) -> Path:
        """Build both coordinates."""
        raise NotImplementedError

    def check_reach(self, arm: ArmParameters) -> None:
        """Raise `ParameterError` unless the arm reaches every point of the box around the path.

        A path around the top of joint 1 is rejected as well, because q1 would jump by a turn there.

        Args:
            arm: Parameters of an arm of two links.

        Raises:
            ParameterError: If a point is out of reach, with the bounds.
        """
        (left, right), (low, high) = (shape.range for shape in self.build_path())
        l1, l2 = (link.length_m for link in arm.chain)
        whole = l1 + l2
        most, least = whole * (1.0 - MARGIN), abs(l1 - l2) + MARGIN * whole
        far = math.hypot(max(-left, right), max(-low, high))
        near = math.hypot(max(left, -right, 0.0), max(low, -high, 0.0))
        box = f"x from {left:.4g} to {right:.4g} m, y from {low:.4g} to {high:.4g} m"
        if far > most or near < least:
            bound = f"within a box whose points are {least:.4g} to {most:.4g} m away from joint 1"
            raise ParameterError(Violation("tip", box, "", bound))
        if left <= 0.0 <= right and high > 0.0:
            bound = "to the left, to the right or below joint 1, not around its top"
            raise ParameterError(Violation("tip", box, "", bound))


class TipEllipse(AnyTipReference):
    """x = x0 + a cos(2π f t), y = y0 + b sin(2π f t)."""

    kind: Literal["ellipse"] = quantity("", "Ellipse", default="ellipse")
    center_m: tuple[_Coordinate, _Coordinate] = quantity("m", f"Center {XY}")
    radii_m: tuple[_Coordinate, _Coordinate] = quantity("m", "Half axes a and b")
    frequency_hz: Number = quantity("Hz", "Frequency f", gt=0, le=5)

    def build_path(self) -> Path:
        """Build both coordinates."""
        (x, y), (a, b), f = self.center_m, self.radii_m, self.frequency_hz
        return Path(build_sine(x, abs(a), f, math.copysign(math.pi / 2, a)), _build_wave(y, b, f))


class TipMove(AnyTipReference):
    """A straight movement from rest to rest with four continuous derivatives, then rest."""

    kind: Literal["move"] = quantity("", "Move", default="move")
    start_m: tuple[_Coordinate, _Coordinate] = quantity("m", f"First point {XY}")
    end_m: tuple[_Coordinate, _Coordinate] = quantity("m", f"Last point {XY}")
    duration_s: Number = quantity("s", "Duration T of the movement", ge=0.2, le=3600)

    @model_validator(mode="after")
    def _check_points(self) -> Self:
        if self.start_m == self.end_m:
            raise ParameterError(Violation("end_m", self.end_m, "m", "another point than start_m"))
        return self

    def build_path(self) -> Path:
        """Build both coordinates."""
        first, second = (
            _build_move(start, end, self.duration_s)
            for start, end in zip(self.start_m, self.end_m, strict=True)
        )
        return Path(first, second)


TipReference: TypeAlias = Annotated[TipEllipse | TipMove, BY_KIND]


def _build_wave(mean: float, amplitude: float, frequency_hz: float) -> Shape:
    return build_sine(mean, abs(amplitude), frequency_hz, 0.0 if amplitude >= 0.0 else math.pi)


def _build_move(start: float, end: float, duration: float) -> Shape:
    """a + (b − a) w(t/T) with the w of `compute_fade`."""
    weights = (126.0, -420.0, 540.0, -315.0, 70.0)
    powers = [(end - start) * w / duration ** (5 + k) for k, w in enumerate(weights)]
    curve = build_curve([(0.0, (start, 0.0, 0.0, 0.0, 0.0, *powers)), (duration, (end,))])
    return build_curve_shape(curve)
