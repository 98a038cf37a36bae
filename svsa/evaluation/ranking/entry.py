"""Rows of the ranking: a law with parameters."""

from typing import Literal, NamedTuple

from svsa.actuators.parameters import SVSA
from svsa.control.installed import (
    PAPERS_LAW,
    check_installed,
    get_title,
    has_own_parameters,
    list_law_names,
)
from svsa.evaluation.actuator_scale import build_scenario_run, scale_rate
from svsa.evaluation.scenario import Scenario
from svsa.evaluation.tuning.search_space import build_space
from svsa.evaluation.tuning.tuned_law import TunedLaw, load_tuned_laws
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Design, Lane
from svsa.runs.definition.design_file import load_prototype
from svsa.runs.definition.shorthand import read_mechanism

Variant = Literal["tuned", "declared", "default"]
DECLARED = f"{PAPERS_LAW}_declared"
"""Key of NDOBC with gains assumed by this project, because the paper prints none."""


class Entry(NamedTuple):
    """A law with parameters.

    Attributes:
        law: Name of the law.
        variant: tuned: by `svsa tune --all`. declared: NDOBC with gains assumed by this project,
            because the paper prints none. default: the defaults of a law that was not tuned.
        design: Gains, observer and parameters.
        actuator: Name of the actuator that scenarios are scaled to.
    """

    law: str
    variant: Variant
    design: Design
    actuator: str = SVSA

    @property
    def tuning(self) -> TunedLaw | None:
        """The tuning of the law for a tuned entry; otherwise None."""
        return load_tuned_laws().get(self.law) if self.variant == "tuned" else None

    @property
    def key(self) -> str:
        """Key of the entry's row in the ranking."""
        return DECLARED if self.variant == "declared" else self.law

    def build_configuration(self, scenario: Scenario) -> Configuration:
        """Build the run of a scenario under the law with the entry's parameters."""
        own = {name: getattr(self.design, name) for name in ("gains", "observer", "parameters")}
        return build_scenario_run(scenario, self.law, self.actuator).changed(**own)

    def build_lane(self) -> Lane:
        """Build a lane of a run with the law and the entry's parameters."""
        if has_own_parameters(self.law):
            return Lane(law=self.law, parameters=self.design.parameters.get(self.law))
        return Lane(law=self.law, gains=self.design.gains, observer=self.design.observer)


def get_entry_title(key: str) -> str:
    """Return the title of a row; for NDOBC with the variant."""
    if key == DECLARED:
        return f"{get_title(PAPERS_LAW)}, declared gains"
    return get_title(key)


def get_reference(law: str) -> str:
    """Return the key of the row to compare with: NDOBC tuned; for it, NDOBC as declared."""
    return DECLARED if law == PAPERS_LAW else PAPERS_LAW


def build_entry(key: str, actuator: str = SVSA) -> Entry:
    """Build the entry of a row's key.

    Laws are tuned for the SVSA. For another actuator the rates among the tuned values (poles,
    bandwidths) are scaled by those of its default gains, see `scale_rate`.

    Args:
        key: Key of the row.
        actuator: Name of the actuator.

    Raises:
        ParameterError: If the law or the actuator is not installed.
    """
    design = load_prototype()
    if actuator != SVSA:
        fields = read_mechanism(actuator)
        design = design.changed(gains=fields["gains"], observer=fields["observer"])
    if key == DECLARED:
        return Entry(PAPERS_LAW, "declared", design, actuator)
    tuned = load_tuned_laws().get(check_installed(key))
    if tuned is None:
        return Entry(key, "default", design, actuator)
    if actuator == SVSA:
        return Entry(key, "tuned", tuned.build_design())
    space = build_space(key)
    scaled = tuple(
        scale_rate(value, axis, actuator)
        for value, axis in zip(tuned.read_values(), space.axes, strict=True)
    )
    return Entry(key, "tuned", space.set_design(design, scaled), actuator)


def list_entry_keys() -> list[str]:
    """List the keys of all rows: NDOBC as declared, then every installed law."""
    return [DECLARED, *list_law_names()]
