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

    kind: Literal["series"] = quantity("", "Series", default="series")
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
        """Sample a torque function.

        Args:
            function: Maps the time since onset, s, to (w2, w4, w6), N·m.
            duration_s: Duration of the load, s.
            step_s: Distance between two samples, s.
            start_s: Session time of the onset, s; None for the current time.

        Returns:
            The load.
        """
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
            raise ParameterError(
                Violation("time_s", list(times[:3]), "s", "increasing, from 0 or later")
            )
        return self

    def get_duration(self) -> float:
        """Return the time of the last point, s."""
        return self.time_s[-1]

    def describe(self) -> str:
        """Describe the load as "torque series"."""
        return "torque series"

    def list_points(self) -> np.ndarray:
        """Return the points of the series, shape (m, 4)."""
        return np.column_stack([self.time_s, self.torque_nm])
