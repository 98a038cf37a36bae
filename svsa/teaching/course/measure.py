"""Measures of an exercise: a statistic of a channel of a run over a time window."""

import math
from collections.abc import Callable, Sequence
from typing import Any, Literal, NamedTuple, Self

import numpy as np
from pydantic import model_validator

from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS
from svsa.errors import ParameterError, Violation
from svsa.evaluation.studies.setting import read_setting
from svsa.inputs.checked import Checked, Number, Whole, quantity
from svsa.runs.definition.command import fold
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import MAX_LANES
from svsa.runs.result.arm import ArmResult
from svsa.runs.result.channels import ChannelName
from svsa.runs.result.result import Result
from svsa.teaching.submission import StepName

Statistic = Literal[
    "mean", "rms", "spread", "peak", "max", "min", "last", "crossing", "rise", "recovery"
]
DEGREE = "°"
_NEEDS_LEVEL = ("crossing", "rise", "recovery")
_TIMES = ("rise", "recovery")


class Measured(NamedTuple):
    """A measured value in the measure's unit.

    Attributes:
        value: None if the run does not determine it; `problem` then has the reason.
        time_s: Time in the run that shows it best, s, or None.
        problem: Reason for a missing value.
    """

    value: float | None
    time_s: float | None = None
    problem: str = ""


class Measure(Checked):
    """A statistic of a channel from `from_s` to `to_s`, of the tip's stiffness, or a setting.

    Statistics: mean, rms, spread (standard deviation), peak (largest magnitude), max, min, last;
    crossing: the channel where `of` first reaches `level`, upwards; rise: time from `from_s` until
    the channel first is at `level` or above; recovery: time from `from_s` after which the channel
    stays within ±`level`.

    Attributes:
        setting: Path in the configuration, such as `observer.bandwidth_rad_per_s[0]`.
        tip_direction_rad: Angle of a direction n of an arm's tip, from horizontal, whose stiffness
            nᵀ K n is taken in place of a channel, with K of `ArmResult.tip_stiffness_n_per_m`.
        lane: That of the channel; for the stiffness of the tip that of joint 1.
        unit: "°" shows radians in degrees.
        per: Another measure by which this one is divided.
    """

    name: StepName
    label: str = quantity("", "Label", min_length=1, max_length=200)
    channel: ChannelName | None = quantity("", "Channel of the samples", default=None)
    setting: str = quantity("", "Path in the configuration", default="", max_length=200)
    tip_direction_rad: Number | None = quantity(
        "rad", "Direction of the tip's stiffness", ge=-math.pi, le=math.pi, default=None
    )
    statistic: Statistic = quantity("", "Statistic of the samples", default="mean")
    lane: Whole = quantity("", "Number of the lane", ge=1, le=MAX_LANES, default=1)
    from_s: Number = quantity("s", "Start of the window", ge=0, default=0.0)
    to_s: Number | None = quantity(
        "s", "End of the window; default: the end of the run", gt=0, default=None
    )
    of: ChannelName | None = quantity("", "Channel that crosses the level", default=None)
    level: Number | None = quantity("", "Level, in the unit of its channel", default=None)
    unit: str = quantity("", "Unit; default: the unit of the channel", default="", max_length=20)
    per: StepName | None = quantity("", "Measure by which it is divided", default=None)

    @model_validator(mode="after")
    def _check(self) -> Self:
        if [self.channel, self.tip_direction_rad, self.setting or None].count(None) != 2:
            bound = "given, or else tip_direction_rad or a setting"
            raise ParameterError(Violation("channel", self.channel, "", bound))
        if (self.statistic in _NEEDS_LEVEL) != (self.level is not None):
            bound = f"given for {' and '.join(_NEEDS_LEVEL)}, and for nothing else"
            raise ParameterError(Violation("level", self.level, "", bound))
        if (self.statistic == "crossing") != (self.of is not None):
            raise ParameterError(Violation("of", self.of, "", "given for crossing, and only there"))
        if self.to_s is not None and self.to_s <= self.from_s:
            raise ParameterError(Violation("to_s", self.to_s, "s", f"after {self.from_s:g} s"))
        if self.unit == DEGREE and not self._own_unit.startswith("rad"):
            bound = f"omitted: {self.channel} is in {self._own_unit or 'no unit'}"
            raise ParameterError(Violation("unit", self.unit, "", bound))
        return self

    @property
    def _own_unit(self) -> str:
        if self.setting:
            return ""
        if self.statistic in _TIMES:
            return "s"
        return "N/m" if self.channel is None else CHANNELS[CHANNEL_INDEX[self.channel]].unit

    @property
    def shown_unit(self) -> str:
        """The unit of the value; "" for a ratio, unless the measure declares a unit."""
        if self.per is not None:
            return "" if self.unit == DEGREE else self.unit
        unit = self.unit or self._own_unit
        return "" if unit == "1" else unit

    def read(self, result: Result) -> Measured:
        """Read the value of the measure in this run, before it is divided by another."""
        if self.setting:
            return Measured(_read_configured(result, self.setting))
        lanes = (result, *result.comparisons)
        if self.lane > len(lanes):
            return Measured(None, None, f"the run has {len(lanes)} lanes, not {self.lane}")
        lane = lanes[self.lane - 1]
        end_s = math.inf if self.to_s is None else self.to_s
        time, values = lane.time_s, self._read_values(lanes)
        rows = (time >= self.from_s - 1e-9) & (time < end_s - 1e-9)
        if self.to_s is not None and not _reaches(result, self.to_s):
            return Measured(None, _end(result), _describe_end(result, self.to_s))
        if not rows.any() or np.isnan(values[rows]).any():
            return Measured(None, None, "the run has no such samples")
        value, row = _STATISTICS[self.statistic](self, lane, values[rows], rows)
        if value is None:
            return Measured(None, None, "it does not come to that in this run")
        shown = math.degrees(value) if self.unit == DEGREE else value
        return Measured(shown, None if row is None else float(time[rows][row]))

    def _read_values(self, lanes: Sequence[Result]) -> np.ndarray:
        """Read the channel, or the stiffness of the tip, of the measure's lane, (ticks,)."""
        if self.channel is not None:
            return lanes[self.lane - 1][self.channel]
        assert self.tip_direction_rad is not None  # noqa: S101
        end = self.lane - 1 + len(lanes[0].configuration.joints)
        return _read_tip_stiffness(lanes[self.lane - 1 : end], self.tip_direction_rad)


def _read_tip_stiffness(joints: Sequence[Result], angle: float) -> np.ndarray:
    """nᵀ K n of the tip of an arm from its joints' samples, (ticks,), N/m."""
    samples = np.stack([joint.samples for joint in joints])
    arm = ArmResult(joints[0].configuration, samples)
    n = np.array([math.cos(angle), math.sin(angle)])
    return np.einsum("i,tij,j->t", n, arm.tip_stiffness_n_per_m, n)


def _reaches(result: Result, time_s: float) -> bool:
    period = result.configuration.sampling.period_s
    return len(result.time_s) > 0 and float(result.time_s[-1]) + 1.5 * period >= time_s


def _end(result: Result) -> float | None:
    return float(result.time_s[-1]) if len(result.time_s) else None


def _describe_end(result: Result, wanted_s: float) -> str:
    if result.fault is not None:
        return f"the run ended before {wanted_s:g} s: {result.fault.message}"
    return f"the run ended before {wanted_s:g} s"


def _read_configured(result: Result, path: str) -> float:
    """Read a setting as it was at the end of the run."""
    configuration, is_bench = result.configuration, result.plant != "simulated"
    for command in result.commands:
        configuration = fold(configuration, command, is_bench)
    return read_number(configuration, path)


def read_number(configuration: Configuration, path: str) -> float:
    """Read the number at a path of the configuration.

    Raises:
        ParameterError: If there is none.
    """
    try:
        value = read_setting(configuration, path)
    except ParameterError as error:
        raise error.within("setting") from None
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ParameterError(Violation("setting", path, "", "the path of a number"))
    return float(value)


Reduced = tuple[float | None, int | None]
_ComputeStatistic = Callable[[Measure, Result, np.ndarray, np.ndarray], Reduced]
_Reduce = Callable[[np.ndarray], Any]


def _find_peak(values: np.ndarray) -> int:
    return int(np.argmax(np.abs(values)))


def _build_statistic(reduce: _Reduce, find_row: _Reduce) -> _ComputeStatistic:
    """Build a statistic that needs the values only; `find_row` returns the sample that represents
    it.
    """

    def take(_: Measure, __: Result, values: np.ndarray, ___: np.ndarray) -> Reduced:
        return float(reduce(values)), int(find_row(values))

    return take


def _compute_crossing(
    measure: Measure, lane: Result, values: np.ndarray, rows: np.ndarray
) -> Reduced:
    """Interpolate linearly between the two samples on both sides of the level."""
    assert measure.of is not None and measure.level is not None  # noqa: S101
    other = lane[measure.of][rows]
    above = np.flatnonzero((other[1:] >= measure.level) & (other[:-1] < measure.level))
    if not len(above):
        return None, None
    row = int(above[0])
    share = float((measure.level - other[row]) / (other[row + 1] - other[row]))
    return float(values[row] + share * (values[row + 1] - values[row])), row + 1


def _compute_rise(measure: Measure, lane: Result, values: np.ndarray, rows: np.ndarray) -> Reduced:
    assert measure.level is not None  # noqa: S101
    there = np.flatnonzero(values >= measure.level)
    if not len(there):
        return None, None
    return float(lane.time_s[rows][there[0]] - measure.from_s), int(there[0])


def _compute_recovery(
    measure: Measure, lane: Result, values: np.ndarray, rows: np.ndarray
) -> Reduced:
    assert measure.level is not None  # noqa: S101
    outside = np.flatnonzero(np.abs(values) > measure.level)
    if not len(outside):
        return 0.0, 0
    if outside[-1] == len(values) - 1:
        return None, None
    time = lane.time_s[rows]
    return float(time[outside[-1] + 1] - time[0]), int(outside[-1]) + 1


_STATISTICS: dict[Statistic, _ComputeStatistic] = {
    "mean": _build_statistic(np.mean, _find_peak),
    "rms": _build_statistic(lambda values: np.sqrt(np.mean(values**2)), _find_peak),
    "spread": _build_statistic(np.std, lambda values: _find_peak(values - np.mean(values))),
    "peak": _build_statistic(lambda values: np.max(np.abs(values)), _find_peak),
    "max": _build_statistic(np.max, np.argmax),
    "min": _build_statistic(np.min, np.argmin),
    "last": _build_statistic(lambda values: values[-1], lambda values: len(values) - 1),
    "crossing": _compute_crossing,
    "rise": _compute_rise,
    "recovery": _compute_recovery,
}
