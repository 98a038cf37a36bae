"""A torque given point by point."""

from collections.abc import Callable, Sequence
from typing import Annotated, ClassVar, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Number, quantity
from svsa.simulation.plant.loads.load import SERIES, TRIPLE, AnyLoad, TorqueTriple

MAX_SERIES_POINTS = 20_000


class SeriesLoad(AnyLoad):
    """A torque given by points in time since the onset, joined by straight lines."""

    acts_as: ClassVar[int] = SERIES

    kind: Literal["series"] = "series"
    time_s: Annotated[tuple[Number, ...], Field(min_length=2, max_length=MAX_SERIES_POINTS)] = (
        quantity("s", "Times since onset, increasing from ≥ 0")
    )
    torque_nm: Annotated[
        tuple[TorqueTriple, ...], Field(min_length=2, max_length=MAX_SERIES_POINTS)
    ] = quantity("N·m", TRIPLE + ", one for each time")

    @classmethod
    def from_function(
        cls,
        function: Callable[[float], Sequence[float]],
        duration_s: float,
        step_s: float = 0.001,
        start_s: float | None = None,
    ) -> Self:
        """A torque (w2, w4, w6) = function(time since onset, s), sampled every `step_s`."""
        count = max(2, round(duration_s / step_s) + 1)
        times = tuple(index * step_s for index in range(min(count, MAX_SERIES_POINTS + 1)))
        torques = tuple(tuple(map(float, function(time))) for time in times)
        return cls(start_s=start_s, time_s=times, torque_nm=torques)  # pyright: ignore[reportArgumentType]

    @model_validator(mode="after")
    def _check_points(self) -> Self:
        times = np.asarray(self.time_s)
        if len(times) != len(self.torque_nm):
            bound = f"as long as time_s, which has {len(times)} points"
            raise ParameterError(Violation("torque_nm", len(self.torque_nm), "points", bound))
        if times[0] < 0.0 or np.any(np.diff(times) <= 0.0):
            raise ParameterError(Violation("time_s", list(times[:3]), "s", "growing from ≥ 0 on"))
        return self

    def get_duration(self) -> float:
        """How long it lasts, s."""
        return self.time_s[-1]

    def describe(self) -> str:
        """A few words, as in the name of a run."""
        return "torque series"

    def list_points(self) -> np.ndarray:
        """Its points (m, 4): time since onset, s, and torques, N·m."""
        return np.column_stack([self.time_s, self.torque_nm])
