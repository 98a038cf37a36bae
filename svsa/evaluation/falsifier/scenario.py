"""A saved scenario: loads and settings in which any law can run."""

from collections.abc import Mapping
from typing import Annotated, Any, NamedTuple, Self

from pydantic import Field, model_validator

from svsa.control.installed import PAPERS_LAW, LawName
from svsa.errors import ParameterError, Violation
from svsa.evaluation.statistics import Interval, estimate_share
from svsa.evaluation.studies.setting import change_settings
from svsa.evaluation.studies.study import FIGURE, build_base, check_measured
from svsa.inputs.checked import Checked, Number, Whole, quantity
from svsa.runs.definition.configuration import MAX_LOADS, Configuration
from svsa.runs.definition.paper import DURATION_S
from svsa.runs.records.former_words import SEARCHES, translate_fields
from svsa.simulation.plant.loads import Load


class Attack(NamedTuple):
    """Loads, and settings by path, that change a base run."""

    loads: tuple[Load, ...]
    settings: Mapping[str, Any]

    def apply(self, base: Configuration) -> Configuration:
        """Apply the attack to a run.

        Raises:
            ParameterError: If the result is inconsistent.
        """
        changed = change_settings(base, self.settings) if self.settings else base
        return changed.model_copy(update={"loads": (*changed.loads, *self.loads)})


class Finding(Checked):
    """The origin of a scenario in a search."""

    law: LawName = quantity("", "Law under test")
    cost: str = quantity("", "Cost of the search", max_length=40)
    outcome: str = quantity("", "Outcome of the law", max_length=200)
    adversary: str = quantity("", "Adversary of the search", max_length=200)
    method: str = quantity("", "Method of the search", max_length=40)
    seed: Whole = quantity("", "Seed of the search", ge=0)
    at_run: Whole = quantity("", "Number of the run that found it", ge=1)
    runs: Whole = quantity("", "Runs of the search", ge=1)
    version: str = quantity("", "Version of the lab that found it", max_length=40)
    neighbors: Whole | None = quantity(
        "",
        "Number of random loads in its neighborhood, each value within 5 % of its range",
        default=None,
    )
    neighbors_failed: Whole | None = quantity(
        "", "Number of those with at least the same effect", ge=0, default=None
    )

    @model_validator(mode="before")
    @classmethod
    def _translate(cls, written: Any) -> Any:
        return translate_fields(written, SEARCHES)

    @property
    def neighborhood(self) -> Interval | None:
        """Share of random loads near it with equal effect; None if none were run."""
        if not self.neighbors or self.neighbors_failed is None:
            return None
        return estimate_share(self.neighbors_failed, self.neighbors)


class LoadScenario(Checked):
    """Loads and settings of a run, with a name.

    Attributes:
        title: Title of the scenario.
        base: Base experiment, as in a study: `figure`, and changed settings.
        duration_s: Duration of the run, s.
        measure_from_s: Time at which measuring begins, s.
        settings: Values by path, such as actuator.link_inertia_kg_m2.
        loads: Loads in addition to those of the base.
        found: Origin of the scenario.

    Raises:
        ParameterError: If a field is invalid.
    """

    title: str = quantity("", "Title of the scenario", max_length=200)
    base: dict[str, Any] = quantity("", "Base configuration", default={FIGURE: "4a"})
    duration_s: Number = quantity("s", "Duration", gt=0, le=3600, default=DURATION_S)
    measure_from_s: Number = quantity("s", "Start of the measured window", ge=0, default=0.0)
    settings: dict[str, Any] = quantity("", "Settings by their paths", default={})
    loads: Annotated[tuple[Load, ...], Field(max_length=MAX_LOADS)] = quantity(
        "", "Loads", default=()
    )
    found: Finding | None = quantity("", "Origin of the scenario", default=None)

    @model_validator(mode="after")
    def _check(self) -> Self:
        check_measured(self.measure_from_s, self.duration_s)
        self.build_configuration(PAPERS_LAW)
        return self

    @property
    def attack(self) -> Attack:
        """The attack of the scenario on its base run."""
        return Attack(self.loads, self.settings)

    def build_configuration(self, law: str) -> Configuration:
        """Build the run of this scenario under a law.

        Args:
            law: Name of an installed law.

        Returns:
            The configuration.

        Raises:
            ParameterError: If the scenario does not fit the base experiment.
        """
        base = build_base(self.base, law)
        check_load_count(len(base.loads) + len(self.loads))
        for path, value in self.settings.items():
            check_setting(base, path, value)
        return self.attack.apply(base)


def check_setting(base: Configuration, path: str, value: Any) -> None:
    """Raise `ParameterError` for an invalid path or an invalid value for it."""
    try:
        change_settings(base, {path: value})
    except ParameterError as error:
        reason = error.violations[0].message.removesuffix(".")
        violation = Violation(
            f"settings.{path}", value, "", "", {}, f"with {value!r:.40}, {reason}"
        )
        raise ParameterError(violation) from None


def check_load_count(count: int) -> None:
    """Raise `ParameterError` for more loads than a run supports, including its base's."""
    if count > MAX_LOADS:
        bound = f"at most {MAX_LOADS}, those of base among them"
        raise ParameterError(Violation("loads", count, "", bound))
