"""One run of the suite: found by its name, and shown next to a comparison."""

from collections.abc import Iterator
from typing import NamedTuple

from svsa.control.installed import get_title
from svsa.errors import ParameterError, Violation
from svsa.evaluation.ranking.measure import Entry, run_scenario
from svsa.evaluation.ranking.scenarios import (
    CORNERS,
    LOAD_REMOVALS,
    MAX_STEP_NM,
    SINGLE,
    STEP_NM,
    Scenario,
    build_link_step,
)
from svsa.evaluation.ranking.sweeps import build_sweeps
from svsa.evaluation.ranking.trials import PUBLIC_SEED, TRIALS, build_trial
from svsa.runs.configuration import Configuration


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


class Seen(NamedTuple):
    """The run to be shown. alone: why nothing is beside the law; "" where something is."""

    configuration: Configuration
    alone: str


def build_seen(scenario: Scenario, law: str) -> Seen:
    """A law in a scenario beside NDOBC, and NDOBC beside FL, or alone where that ends first.

    The lanes of a run end together: a law is alone where its own run, which is the one that was
    measured, goes on for longer than the other's.
    """
    compared = scenario.build_compared(law)
    (baseline,) = compared.comparisons
    ticks = len(run_scenario(scenario, Entry(law)).samples)
    alone = explain_alone(scenario, get_title(law), baseline.law, ticks)
    return Seen(scenario.build_configuration(law) if alone else compared, alone)


def explain_alone(scenario: Scenario, name: str, baseline: str, ticks: int) -> str:
    """Why another law cannot be beside one whose run has so many ticks; "" where it can.

    name: of the one that is shown.
    """
    fault = run_scenario(scenario, Entry(baseline)).fault
    if fault is None or fault.tick >= ticks:
        return ""
    other = get_title(baseline)
    return (
        f"In “{scenario.title}” nothing was put beside {name}: the earlier end of {other} there"
        f" would have ended both. {other}: {fault.message}"
    )
