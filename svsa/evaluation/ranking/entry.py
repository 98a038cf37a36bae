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
from svsa.evaluation.actuator_scale import build_scenario_run
from svsa.evaluation.scenario import Scenario
from svsa.evaluation.tuning.tuned_law import TunedLaw, load_tuned_laws
from svsa.runs.configuration import Configuration, Design, Lane, load_prototype

Variant = Literal["tuned", "declared", "default"]
DECLARED = f"{PAPERS_LAW}_declared"
"""Key of NDOBC with the gains declared for the paper, which prints none."""


class Entry(NamedTuple):
    """A law with parameters.

    Attributes:
        law: Name of the law.
        variant: tuned: by `svsa tune --all`. declared: NDOBC with the gains declared for the paper,
            which prints none. default: the law's defaults, of a law that was not tuned.
        design: Gains, observer and parameters.
        actuator: Name of the actuator that scenarios are scaled to.
    """

    law: str
    variant: Variant
    design: Design
    actuator: str = SVSA

    @property
    def tuning(self) -> TunedLaw | None:
        """The tuning of its parameters; None for parameters without one."""
        return load_tuned_laws().get(self.law) if self.variant == "tuned" else None

    @property
    def key(self) -> str:
        """Key of its row."""
        return DECLARED if self.variant == "declared" else self.law

    def build_configuration(self, scenario: Scenario) -> Configuration:
        """Build its run of a scenario."""
        own = {name: getattr(self.design, name) for name in ("gains", "observer", "parameters")}
        return build_scenario_run(scenario, self.law, self.actuator).changed(**own)

    def build_lane(self) -> Lane:
        """Build its controller as a lane."""
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


def build_entry(key: str) -> Entry:
    """Build the entry of a row's key; raises `ParameterError` for a law that is not installed."""
    if key == DECLARED:
        return Entry(PAPERS_LAW, "declared", load_prototype())
    tuned = load_tuned_laws().get(check_installed(key))
    if tuned is None:
        return Entry(key, "default", load_prototype())
    return Entry(key, "tuned", tuned.build_design())


def list_entry_keys() -> list[str]:
    """List the keys of all rows: NDOBC as declared, then every installed law."""
    return [DECLARED, *list_law_names()]
