"""A run of the suite by its name."""

from collections.abc import Iterator

from svsa.errors import ParameterError, Violation
from svsa.evaluation.ranking.scenarios import (
    CORNERS,
    LOAD_REMOVALS,
    MAX_STEP_NM,
    SINGLE,
    STEP_NM,
    Scenario,
    build_link_step,
)
from svsa.evaluation.ranking.seeds import PUBLIC_SEED
from svsa.evaluation.ranking.sweeps import build_sweeps
from svsa.evaluation.ranking.trials import TRIALS, build_trial


def find_scenario(name: str, seed: int = PUBLIC_SEED) -> Scenario:
    """The run of this name; seed: of the season of trials. Raises `ParameterError` for no such."""
    for scenario in list_scenarios(seed):
        if scenario.name == name:
            return scenario
    bound = "a scenario, such as rig_4a, load_removal_15_4, trial_12, link_step_2.5 or delay_3_0"
    raise ParameterError(Violation("scenario", name, "", bound))


def list_scenarios(seed: int = PUBLIC_SEED) -> Iterator[Scenario]:
    """Every run of the suite."""
    yield from (*SINGLE, *LOAD_REMOVALS, *CORNERS)
    for count in range(1, round(MAX_STEP_NM / STEP_NM) + 1):
        yield build_link_step(count * STEP_NM)
    for number in range(TRIALS):
        yield build_trial(number, seed)
    for sweep in build_sweeps():
        for runs in sweep.runs:
            yield from runs
