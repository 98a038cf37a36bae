"""Every reference that q_d and σ_d may follow."""

from typing import Annotated

from svsa.inputs.checked import BY_KIND
from svsa.simulation.reference.chirp import ChirpPosition, ChirpStiffness
from svsa.simulation.reference.minimum_jerk import MinimumJerkPosition, MinimumJerkStiffness
from svsa.simulation.reference.series import SeriesPosition, SeriesStiffness
from svsa.simulation.reference.sine import (
    ConstantPosition,
    ConstantStiffness,
    SinePosition,
    SineStiffness,
)
from svsa.simulation.reference.steps import StepsPosition, StepsStiffness

AnyPosition = (
    SinePosition
    | ConstantPosition
    | StepsPosition
    | MinimumJerkPosition
    | ChirpPosition
    | SeriesPosition
)
AnyStiffness = (
    SineStiffness
    | ConstantStiffness
    | StepsStiffness
    | MinimumJerkStiffness
    | ChirpStiffness
    | SeriesStiffness
)
PositionReference = Annotated[AnyPosition, BY_KIND]
StiffnessReference = Annotated[AnyStiffness, BY_KIND]
Trajectory = AnyPosition | AnyStiffness


def get_range(trajectory: Trajectory) -> tuple[float, float]:
    """The least and the greatest value that a trajectory takes, in its own unit."""
    return trajectory.get_shape().range


def compute_start_value(trajectory: Trajectory) -> float:
    """The value at t = 0, in the trajectory's own unit."""
    return trajectory.get_shape().start
