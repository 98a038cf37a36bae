"""A study as a value: variations, number of runs, laws and success criterion."""

import math
from collections.abc import Mapping
from typing import Any, Literal, Self, TypeGuard

from pydantic import model_validator

from svsa.control.installed import PAPERS_LAW, InstalledLaw
from svsa.errors import ParameterError, Violation
from svsa.evaluation.metrics import METRICS, Metric
from svsa.evaluation.studies.outcome import Success
from svsa.evaluation.studies.setting import ACTUATOR, change_settings, read_setting
from svsa.evaluation.studies.variation import DRAWN, Choice, Grid, Variation, Variations
from svsa.inputs.checked import Checked, Number, Whole, quantity
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.paper import DURATION_S, get_simulated_figure

MAX_RUNS = 10**9
MAX_LAWS = 20
FIGURE = "figure"
Sampling = Literal["random", "sobol", "sensitivity"]


class Study(Checked):
    """Runs of one actuator with varied settings, and the same samples under each law.

    Attributes:
        title: Title of the study.
        base: Base configuration: `figure` of the paper, and changed settings.
        vary: Varied settings.
        actuators: If the actuator varies (`vary` with the path "actuator" and names as values):
            settings of each that replace those of the base, such as a stiffness in its range.
        runs: Number of samples; with grids, of the whole grid; for `sensitivity` the number of base
            samples, a power of two.
        seed: Seed of the samples.
        sampling: Independent samples, Sobol's sequence, or pairs of it for Sobol indices.
        duration_s: Duration of a run, s.
        measure_from_s: Time at which measuring begins, s.
        metrics: Columns of the table in this order; the success criterion may use others.
        success: Success criterion.

    Raises:
        ParameterError: If a value is invalid, also in the base or in the varied settings.
    """

    title: str = quantity("", "Title of the study", max_length=200)
    base: dict[str, Any] = quantity("", "Initial settings of all runs", default={FIGURE: "4a"})
    laws: tuple[InstalledLaw, ...] = quantity(
        "",
        "Laws, each on the same samples",
        min_length=1,
        max_length=MAX_LAWS,
        default=(PAPERS_LAW,),
    )
    vary: Variations = quantity("", "Variations", default=())
    actuators: dict[str, dict[str, Any]] = quantity(
        "", "Settings of each actuator that varies, by its name", default={}
    )
    runs: Whole = quantity("", "Number of samples", ge=1, le=MAX_RUNS)
    seed: Whole = quantity("", "Seed of all samples", ge=0, le=2**63 - 1, default=0)
    sampling: Sampling = quantity("", "Sampling method", default="random")
    duration_s: Number = quantity("s", "Duration of a run", gt=0, le=3600, default=DURATION_S)
    measure_from_s: Number = quantity("s", "Start of the measured window", ge=0, default=0.0)
    metrics: tuple[Metric, ...] = quantity(
        "", "Metrics stored for each run", min_length=1, default=tuple(METRICS)
    )
    success: Success = quantity("", "Success criterion, in addition to no fault", default=Success())

    @model_validator(mode="after")
    def _check(self) -> Self:
        check_measured(self.measure_from_s, self.duration_s)
        self._check_once("laws", self.laws)
        self._check_once("metrics", self.metrics)
        self._check_paths()
        if self.sampling == "sensitivity":
            self._check_sensitivity()
        self._check_actuators()
        for law in self.laws:
            for base in self.build_bases(law).values():
                for number, variation in enumerate(self.vary):
                    if not _is_actuator(variation):
                        check_variation(base, variation, f"vary[{number}]")
        if self.sample_count > MAX_RUNS:
            bound = f"so few that there are at most {MAX_RUNS} samples, not {self.sample_count}"
            raise ParameterError(Violation("runs", self.runs, "", bound))
        return self

    def _check_once(self, name: str, listed: tuple[str, ...]) -> None:
        if len(set(listed)) < len(listed):
            raise ParameterError(Violation(name, list(listed), "", "names, each once"))

    def _check_paths(self) -> None:
        paths = [variation.path for variation in self.vary]
        for number, path in enumerate(paths):
            if path in paths[:number]:
                raise ParameterError(Violation(f"vary[{number}].path", path, "", "varied once"))
            whole = [variation.path for variation in self.vary if not _is_actuator(variation)]
            if any(path.startswith((f"{other}.", f"{other}[")) for other in whole):
                bound = "another path: a varied path already contains it"
                raise ParameterError(Violation(f"vary[{number}].path", path, "", bound))

    def _check_actuators(self) -> None:
        unused = sorted({*self.actuators} - {*self.varied_actuators})
        if unused:
            bound = f"an actuator that is varied: {', '.join(self.varied_actuators) or 'none'}"
            raise ParameterError(Violation(f"actuators.{unused[0]}", unused[0], "", bound))

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
        """Number of samples in a cell: of the grid, or of a set of Sobol samples."""
        if self.sampling == "sensitivity":
            return len(self.vary) + 2
        return math.prod(len(variation.levels) or 1 for variation in self.vary)

    @property
    def sample_count(self) -> int:
        """Number of samples; every law runs each of them."""
        return self.runs * self.cells

    @property
    def row_count(self) -> int:
        """Number of runs."""
        return self.sample_count * len(self.laws)

    @property
    def varied_actuators(self) -> tuple[str, ...]:
        """Names of the varied actuators; empty if only the base's actuator runs."""
        for variation in self.vary:
            if _is_actuator(variation):
                return tuple(dict.fromkeys(variation.values))
        return ()

    def build_base(self, law: str) -> Configuration:
        """Build the base configuration of a law's runs, of the first actuator if it varies.

        Raises:
            ParameterError: If the base is invalid for the law.
        """
        return next(iter(self.build_bases(law).values()))

    def build_bases(self, law: str) -> dict[str | None, Configuration]:
        """Build the base configurations of a law's runs by actuator; by None if it does not vary.

        Raises:
            ParameterError: If the base is invalid for the law.
        """
        names = self.varied_actuators
        if not names:
            return {None: build_base(self.base, law)}
        return {
            name: build_base({**self.base, **self.actuators.get(name, {}), ACTUATOR: name}, law)
            for name in names
        }


def _is_actuator(variation: Variation) -> TypeGuard[Choice | Grid]:
    """Whether it varies the actuator by name."""
    if variation.path != ACTUATOR or not isinstance(variation, Choice | Grid):
        return False
    return all(isinstance(value, str) for value in variation.values)


def check_measured(measure_from_s: float, duration_s: float) -> None:
    """Raise `ParameterError` if a run ends before its measured window."""
    if not measure_from_s < duration_s:
        bound = f"less than duration_s, {duration_s:g} s"
        raise ParameterError(Violation("measure_from_s", measure_from_s, "s", bound))


def build_base(base: Mapping[str, Any], law: str) -> Configuration:
    """Build a figure with changed settings under a law.

    Raises:
        ParameterError: If a setting is invalid.
    """
    changes = {name: value for name, value in base.items() if name != FIGURE}
    try:
        figure = get_simulated_figure(base.get(FIGURE, "4a"))
        return change_settings(figure.build_configuration(law), changes)
    except ParameterError as error:
        raise error.within("base") from None


def check_variation(base: Configuration, variation: Variation, name: str) -> None:
    """Raise `ParameterError` if a bound of a variation is invalid for its setting."""
    try:
        present = read_setting(base, variation.path)
    except ParameterError as error:
        inner = error.violations[0]
        bound = f"a setting: in place of {inner.value!r} it must be {inner.bound}"
        raise ParameterError(Violation(f"{name}.path", variation.path, "", bound)) from None
    if variation.relative and not _is_numeric(present):
        bound = "false: the base value is not a number"
        raise ParameterError(Violation(f"{name}.relative", True, "", bound))
    for field, value in variation.list_tried().items():
        if variation.relative and not _is_numeric(value):
            raise ParameterError(Violation(f"{name}.{field}", value, "", "a number, as a factor"))
        try:
            change_settings(base, {variation.path: scale(variation, present, value)})
        except ParameterError as error:
            finding = f"with {value!r:.40} there, {error.violations[0].message.removesuffix('.')}"
            raise ParameterError(Violation(f"{name}.{field}", value, "", "", {}, finding)) from None


def scale(variation: Variation, present: Any, value: Any) -> Any:
    """Return the factor-scaled value of a setting whose base value is `present`."""
    if not variation.relative:
        return value
    return (
        tuple(number * value for number in present)
        if isinstance(present, tuple)
        else present * value
    )


def _is_numeric(value: Any) -> bool:
    numbers = value if isinstance(value, tuple) and value else (value,)
    return all(
        isinstance(number, int | float) and not isinstance(number, bool) for number in numbers
    )
