"""A law's run as it is shown: beside another's, as long as that one does not end it early."""

from typing import NamedTuple

from svsa.control.installed import get_title
from svsa.evaluation.ranking.measure import Entry, run_scenario
from svsa.evaluation.ranking.scenarios import Scenario
from svsa.runs.configuration import Configuration


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
    (beside,) = compared.comparisons
    ticks = len(run_scenario(scenario, Entry(law)).samples)
    alone = explain_alone(scenario, get_title(law), beside.law, ticks)
    return Seen(scenario.build_configuration(law) if alone else compared, alone)


def explain_alone(scenario: Scenario, name: str, beside: str, ticks: int) -> str:
    """Why another law cannot be beside one whose run has so many ticks; "" where it can.

    name: of the one that is shown.
    """
    fault = run_scenario(scenario, Entry(beside)).fault
    if fault is None or fault.tick >= ticks:
        return ""
    other = get_title(beside)
    return (
        f"In “{scenario.title}” nothing was put beside {name}: the earlier end of {other} there"
        f" would have ended both. {other}: {fault.message}"
    )
