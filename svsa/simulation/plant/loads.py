"""Loads: what a student can do to the actuator, and what the plant feels of it."""

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Annotated, Literal, NamedTuple, Self

import numpy as np
from pydantic import Field, model_validator

from svsa.actuators.dynamics import ExternalLoad
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import BY_KIND, Checked, Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose, some
from svsa.numerics.simd.each import call_where
from svsa.numerics.simd.memory import make_alike, read
from svsa.numerics.trigonometry import sin

GRAVITY_M_PER_S2 = 9.81
PAPER_TORQUE_NM = 2.0
PAPER_MASS_KG = 3.0
PAPER_ARM_M = 0.068
MAX_SERIES_POINTS = 20_000

_Torque = Annotated[Number, Field(ge=-50, le=50)]
TorqueTriple = tuple[_Torque, _Torque, _Torque]
_TRIPLE = "(w2, w4, w6) on link, motor 1, motor 2, each from −50 to 50"
_PARTS = ("Load on the link", "Load on motor 1", "Load on motor 2")


class _Load(Checked):
    """A load with the session time at which it comes on; left out, it is now."""

    start_s: Number | None = quantity("s", "Session time of onset", ge=0, le=1e6, default=None)

    def get_duration(self) -> float:
        """How long it lasts, s; infinite unless the load says otherwise."""
        return math.inf


class PaperLoad(_Load):
    """The paper's 3 kg: w2 = w4 = w6 = 2 N·m, as printed."""

    kind: Literal["paper"] = "paper"


class MassLoad(_Load):
    """A mass on an arm of the link: adds inertia m r² and gravity m g r sin q."""

    kind: Literal["mass"] = "mass"
    mass_kg: Number = quantity("kg", "Mass m", gt=0, le=20, default=PAPER_MASS_KG)
    arm_m: Number = quantity("m", "Arm r", gt=0, le=1, default=PAPER_ARM_M)


class ConstantLoad(_Load):
    """A torque that stays from its onset on: a step."""

    kind: Literal["constant"] = "constant"
    torque_nm: TorqueTriple = quantity("N·m", _TRIPLE, symbol="Load", parts=_PARTS)


class PulseLoad(_Load):
    """A torque for a while."""

    kind: Literal["pulse"] = "pulse"
    torque_nm: TorqueTriple = quantity("N·m", _TRIPLE, symbol="Load", parts=_PARTS)
    duration_s: Number = quantity("s", "Duration", gt=0, le=3600)

    def get_duration(self) -> float:
        """How long it lasts, s."""
        return self.duration_s


class PushLoad(_Load):
    """A torque that somebody holds: told again, it is changed and lasts on; else it ends.

    One is on at a time: the next one told while it is on takes its place, see `continue_push`.
    """

    kind: Literal["push"] = "push"
    torque_nm: TorqueTriple = quantity("N·m", _TRIPLE, symbol="Load", parts=_PARTS)
    hold_s: Number = quantity("s", "How long it lasts after it was told", gt=0, le=60, default=0.5)

    def get_duration(self) -> float:
        """How long it lasts, s, unless it is told again."""
        return self.hold_s


class SineLoad(_Load):
    """torque · sin(2π f (t − onset) + phase)."""

    kind: Literal["sine"] = "sine"
    torque_nm: TorqueTriple = quantity("N·m", _TRIPLE, symbol="Load", parts=_PARTS)
    frequency_hz: Number = quantity("Hz", "Frequency f", gt=0, le=100)
    phase_rad: Number = quantity("rad", "Phase", ge=-2 * math.pi, le=2 * math.pi, default=0.0)


class SeriesLoad(_Load):
    """A torque of one's own: points in time since the onset, joined by straight lines."""

    kind: Literal["series"] = "series"
    time_s: Annotated[tuple[Number, ...], Field(min_length=2, max_length=MAX_SERIES_POINTS)] = (
        quantity("s", "Times since onset, growing from ≥ 0")
    )
    torque_nm: Annotated[
        tuple[TorqueTriple, ...], Field(min_length=2, max_length=MAX_SERIES_POINTS)
    ] = quantity("N·m", _TRIPLE + ", one for each time")

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


Load = Annotated[
    PaperLoad | MassLoad | ConstantLoad | PulseLoad | PushLoad | SineLoad | SeriesLoad,
    BY_KIND,
]


def get_hung_mass(load: Load) -> float:
    """The mass that a load hangs on the link, kg; the paper's torque counts as 3 kg."""
    match load:
        case MassLoad():
            return load.mass_kg
        case PaperLoad():
            return PAPER_MASS_KG
    return 0.0


CONSTANT, SINE, MASS, SERIES = range(4)
KIND, W2, W4, W6, START, END, OMEGA, PHASE, INERTIA, MOMENT, FIRST, LENGTH = range(12)


class LoadTable(NamedTuple):
    """All loads of a session as arrays for the compiled loop.

    rows: (n, 12) by the column names above, START and END in ticks; (n, 12, 8) for runs that have
    other loads each. points: (m, 4) time since onset (s) and torques (N·m) of every series load,
    each from FIRST on. changing: whether one of them changes within a period.
    """

    rows: np.ndarray
    points: np.ndarray
    changing: bool


class ScheduledLoad(NamedTuple):
    """A load of a session: its number, and its onset and end in ticks."""

    number: int
    load: Load
    start_tick: int
    end_tick: float

    def is_on(self, tick: int) -> bool:
        """Whether it acts during the sample that begins at this tick."""
        return self.start_tick <= tick < self.end_tick


def schedule_load(number: int, load: Load, tick: int, period: float) -> ScheduledLoad:
    """Onset and end in whole ticks of `period` (s); an onset in the past is now (`tick`)."""
    start = tick if load.start_s is None else max(tick, round(load.start_s / period))
    duration = load.get_duration()
    # At least one tick, or a pulse shorter than half a period would not exist.
    end = math.inf if math.isinf(duration) else start + max(1, round(duration / period))
    return ScheduledLoad(number, load, start, end)


def continue_push(
    loads: Iterable[ScheduledLoad], load: Load, tick: int, period: float
) -> ScheduledLoad | None:
    """The push that is on, as `load` changes it from `tick` on; None where it changes none.

    Number and onset stay, so that a push is one load from its beginning to its end.
    """
    if isinstance(load, PushLoad) and load.start_s is None:
        for held in loads:
            if isinstance(held.load, PushLoad) and held.is_on(tick):
                reported = schedule_load(held.number, load, tick, period)
                return reported._replace(start_tick=held.start_tick)
    return None


def build_load_table(loads: tuple[ScheduledLoad, ...]) -> LoadTable:
    """The arrays of `LoadTable` for these loads; they add up where they overlap."""
    rows = np.zeros((len(loads), 12))
    series: list[np.ndarray] = [np.zeros((0, 4))]
    for row, (_, load, start, end) in zip(rows, loads, strict=True):
        row[START], row[END] = start, end
        match load:
            case PaperLoad():
                row[KIND], row[W2 : W6 + 1] = CONSTANT, PAPER_TORQUE_NM
            case ConstantLoad() | PulseLoad() | PushLoad():
                row[KIND], row[W2 : W6 + 1] = CONSTANT, load.torque_nm
            case SineLoad():
                row[KIND], row[W2 : W6 + 1] = SINE, load.torque_nm
                row[OMEGA], row[PHASE] = 2.0 * math.pi * load.frequency_hz, load.phase_rad
            case MassLoad():
                row[KIND] = MASS
                row[INERTIA] = load.mass_kg * load.arm_m**2
                row[MOMENT] = load.mass_kg * GRAVITY_M_PER_S2 * load.arm_m
            case SeriesLoad():
                row[KIND] = SERIES
                row[FIRST], row[LENGTH] = sum(map(len, series)), len(load.time_s)
                series.append(np.column_stack([load.time_s, load.torque_nm]))
    changing = any(isinstance(load.load, SineLoad | SeriesLoad) for load in loads)
    return LoadTable(rows, np.vstack(series), changing)


@compiled
def compute_load(table: LoadTable, tick: int, period: float, time: float) -> ExternalLoad:
    """The sum of all active loads at `time`, during the sample that began at `tick`.

    Whether a load is on is decided by the tick, so that a step falls between two samples
    and never inside one; its shape is taken at `time` (s). table: `LoadTable`. period: T,
    s. Returns `ExternalLoad`.
    """
    r = table.rows
    w2 = w4 = w6 = inertia = moment = make_alike(r, 0.0)
    for i in range(r.shape[0]):
        start, kind = read(r, i, START), read(r, i, KIND)
        is_on = (start <= tick) & (tick < read(r, i, END))
        if not some(is_on):
            continue
        since = time - start * period
        is_mass, is_series = is_on & (kind == MASS), is_on & (kind == SERIES)
        inertia = choose(is_mass, inertia + read(r, i, INERTIA), inertia)
        moment = choose(is_mass, moment + read(r, i, MOMENT), moment)
        place = table.points, read(r, i, FIRST), read(r, i, LENGTH), since
        s2, s4, s6 = call_where(is_series, interpolate, place, (0.0, 0.0, 0.0))
        shape = 1.0
        if some(kind == SINE):
            wave = sin(read(r, i, OMEGA) * since + read(r, i, PHASE))
            shape = choose(kind == SINE, wave, 1.0)
        is_shaped = is_on & (kind <= SINE)
        w2 = choose(is_shaped, w2 + shape * read(r, i, W2), w2 + s2)
        w4 = choose(is_shaped, w4 + shape * read(r, i, W4), w4 + s4)
        w6 = choose(is_shaped, w6 + shape * read(r, i, W6), w6 + s6)
    return ExternalLoad(w2, w4, w6, inertia, moment)


@compiled
def interpolate(
    points: np.ndarray, first: float, length: float, time: float
) -> tuple[float, float, float]:
    """The torques of `length` points from `first` on, whole numbers, at `time` (s).

    On straight lines between them; zero before them.
    """
    low = int(first)
    if time < points[low, 0]:
        return 0.0, 0.0, 0.0
    high = low + int(length) - 1
    while high - low > 1:
        middle = (low + high) // 2
        if points[middle, 0] <= time:
            low = middle
        else:
            high = middle
    share = min((time - points[low, 0]) / (points[high, 0] - points[low, 0]), 1.0)
    return (
        points[low, 1] + share * (points[high, 1] - points[low, 1]),
        points[low, 2] + share * (points[high, 2] - points[low, 2]),
        points[low, 3] + share * (points[high, 3] - points[low, 3]),
    )
