"""A study as a value: what varies, how many runs, under which laws, and what counts as success."""

import math
from collections.abc import Mapping
from typing import Any, Literal, Self

from pydantic import model_validator

from svsa.checked import Checked, Number, Whole, quantity
from svsa.control.installed import PAPERS_LAW, InstalledLaw
from svsa.errors import ParameterError, Violation
from svsa.paper import DURATION_S, get_figure
from svsa.run.configuration import Configuration
from svsa.study.setting import change_settings, read_setting
from svsa.study.variation import DRAWN, Variation, Variations

MAX_RUNS = 10**9
MAX_LAWS = 20
FIGURE = "figure"
Sampling = Literal["random", "sobol", "sensitivity"]


class Success(Checked):
    """What a run must keep besides its domain, each at most; what is left out is not asked."""

    rms_position_error_rad: Number | None = quantity("rad", "rms of q_d − q", gt=0, default=None)
    peak_position_error_rad: Number | None = quantity(
        "rad", "Largest |q_d − q|", gt=0, default=None
    )
    rms_stiffness_error_nm_per_rad: Number | None = quantity(
        "N·m/rad", "rms of σ_d − σ", gt=0, default=None
    )
    peak_stiffness_error_nm_per_rad: Number | None = quantity(
        "N·m/rad", "Largest |σ_d − σ|", gt=0, default=None
    )
    settled_position_error_rad: Number | None = quantity(
        "rad", "rms of q_d − q over the last 0.5 s", gt=0, default=None
    )
    recovery_time_s: Number | None = quantity(
        "s", "Until |q_d − q| stays within 2 % of its peak for 0.5 s", gt=0, default=None
    )
    last_position_error_rad: Number | None = quantity(
        "rad", "|q_d − q| in the last sample", gt=0, default=None
    )

    def list_bounds(self) -> dict[str, float]:
        """The greatest value of each metric that is asked for."""
        return {name: value for name, value in self if value is not None}


class Study(Checked):
    """Runs of one actuator with varied settings, the same draws under each law.

    base: the configuration that all begin from: `figure` of the paper, and settings in its place.
    runs: how many draws; where there are grids, of the whole grid; for `sensitivity` how many base
    samples, a power of two. sampling: independent draws, Sobol's sequence, or the pairs of it of
    which Sobol indices are made. Raises `ParameterError` for every wrong value, those of the base
    and of what varies among them.
    """

    title: str = quantity("", "What the study is about", max_length=200)
    base: dict[str, Any] = quantity("", "Settings that all runs begin from", default={FIGURE: "4a"})
    laws: tuple[InstalledLaw, ...] = quantity(
        "", "Laws, each on the same draws", min_length=1, max_length=MAX_LAWS, default=(PAPERS_LAW,)
    )
    vary: Variations = quantity("", "What varies", default=())
    runs: Whole = quantity("", "How many draws", ge=1, le=MAX_RUNS)
    seed: Whole = quantity("", "Seed of all draws", ge=0, le=2**63 - 1, default=0)
    sampling: Sampling = quantity("", "How is drawn", default="random")
    duration_s: Number = quantity("s", "How long a run is", gt=0, le=3600, default=DURATION_S)
    measure_from_s: Number = quantity("s", "From when on it is measured", ge=0, default=0.0)
    success: Success = quantity("", "What counts as success, besides no fault", default=Success())

    @model_validator(mode="after")
    def _check(self) -> Self:
        check_measured(self.measure_from_s, self.duration_s)
        self._check_names()
        if self.sampling == "sensitivity":
            self._check_sensitivity()
        for law in self.laws:
            base = self.build_base(law)
            for number, variation in enumerate(self.vary):
                check_variation(base, variation, f"vary[{number}]")
        if self.draw_count > MAX_RUNS:
            bound = f"so few that there are at most {MAX_RUNS} draws, not {self.draw_count}"
            raise ParameterError(Violation("runs", self.runs, "", bound))
        return self

    def _check_names(self) -> None:
        if len(set(self.laws)) < len(self.laws):
            raise ParameterError(Violation("laws", list(self.laws), "", "names, each once"))
        paths = [variation.path for variation in self.vary]
        for number, path in enumerate(paths):
            if path in paths[:number]:
                raise ParameterError(Violation(f"vary[{number}].path", path, "", "varied once"))
            if any(path.startswith((f"{other}.", f"{other}[")) for other in paths):
                bound = "apart from the others: one that varies too holds it"
                raise ParameterError(Violation(f"vary[{number}].path", path, "", bound))

    def _check_sensitivity(self) -> None:
        if self.runs & (self.runs - 1) or not self.vary:
            bound = "a power of two, of at least one setting that varies, for sensitivity"
            raise ParameterError(Violation("runs", self.runs, "", bound))
        for number, variation in enumerate(self.vary):
            if not isinstance(variation, DRAWN):
                bound = "uniform, log_uniform, normal or choice, for sensitivity"
                raise ParameterError(Violation(f"vary[{number}].kind", variation.kind, "", bound))

    @property
    def cells(self) -> int:
        """How many draws belong to one sample: those of the grid, or of the base sample's set."""
        if self.sampling == "sensitivity":
            return len(self.vary) + 2
        return math.prod(len(variation.levels) or 1 for variation in self.vary)

    @property
    def draw_count(self) -> int:
        """How many draws there are, each of which every law runs."""
        return self.runs * self.cells

    @property
    def row_count(self) -> int:
        """How many runs there are."""
        return self.draw_count * len(self.laws)

    def build_base(self, law: str) -> Configuration:
        """What the runs of a law begin from; raises `ParameterError`."""
        return build_base(self.base, law)


def check_measured(measure_from_s: float, duration_s: float) -> None:
    """Raise `ParameterError` where a run ends before it is measured."""
    if not measure_from_s < duration_s:
        bound = f"less than duration_s, {duration_s:g} s"
        raise ParameterError(Violation("measure_from_s", measure_from_s, "s", bound))


def build_base(base: Mapping[str, Any], law: str) -> Configuration:
    """A figure and settings in its place, under a law; raises `ParameterError`."""
    changes = {name: value for name, value in base.items() if name != FIGURE}
    try:
        figure = get_figure(base.get(FIGURE, "4a"))
        return change_settings(figure.build_configuration(law), changes)
    except ParameterError as error:
        raise error.within("base") from None


def check_variation(base: Configuration, variation: Variation, name: str) -> None:
    """Raise `ParameterError` where a value at an end is none for its setting."""
    try:
        present = read_setting(base, variation.path)
    except ParameterError as error:
        inner = error.violations[0]
        bound = f"a setting: in place of {inner.value!r} it must be {inner.bound}"
        raise ParameterError(Violation(f"{name}.path", variation.path, "", bound)) from None
    if variation.relative and not _is_numeric(present):
        bound = "false: what is there is no number to be a factor of"
        raise ParameterError(Violation(f"{name}.relative", True, "", bound))
    for field, value in variation.list_tried().items():
        if variation.relative and not _is_numeric(value):
            raise ParameterError(Violation(f"{name}.{field}", value, "", "a number, as a factor"))
        try:
            change_settings(base, {variation.path: scale(variation, present, value)})
        except ParameterError as error:
            told = f"with {value!r:.40} there, {error.violations[0].message.removesuffix('.')}"
            raise ParameterError(Violation(f"{name}.{field}", value, "", "", {}, told)) from None


def scale(variation: Variation, present: Any, value: Any) -> Any:
    """What a setting becomes whose value in the base is `present`."""
    if not variation.relative:
        return value
    return tuple(one * value for one in present) if isinstance(present, tuple) else present * value


def _is_numeric(value: Any) -> bool:
    numbers = value if isinstance(value, tuple) and value else (value,)
    return all(isinstance(one, int | float) and not isinstance(one, bool) for one in numbers)
