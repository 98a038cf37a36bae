"""One run of the ranking with a baseline, for display."""

from typing import NamedTuple

from svsa.control.installed import BASELINE
from svsa.errors import Fault
from svsa.evaluation.ranking.entry import DECLARED, Entry, build_entry, get_entry_title
from svsa.evaluation.scenario import Scenario
from svsa.runs.definition.configuration import Configuration
from svsa.runs.result.simulate import simulate


class ShownRun(NamedTuple):
    """A run for display.

    Attributes:
        configuration: Configuration of the run.
        titles: Titles of its lanes.
        alone: Reason why it has no baseline; empty if it has one.
    """

    configuration: Configuration
    titles: tuple[str, ...]
    alone: str


def build_shown_run(scenario: Scenario, key: str) -> ShownRun:
    """Build a run of an entry in a scenario with NDOBC (declared gains) as comparison, and of the
    latter with FL.

    All lanes of a run end together: an entry is shown alone if its comparison would end earlier.
    """
    entry = build_entry(key)
    comparison = build_entry(BASELINE if key == DECLARED else DECLARED)
    _, ticks = _run(scenario, entry)
    configuration = entry.build_configuration(scenario)
    titles = (get_entry_title(key), get_entry_title(comparison.key))
    alone = explain_alone(scenario, titles[0], comparison.key, ticks)
    if alone:
        return ShownRun(configuration, titles[:1], alone)
    return ShownRun(configuration.changed(comparisons=(comparison.build_lane(),)), titles, "")


def explain_alone(scenario: Scenario, name: str, key: str, ticks: int) -> str:
    """Explain why an entry cannot be the baseline of a run of this length; empty if it can.

    `name` is the title of the law that is shown.
    """
    fault, _ = _run(scenario, build_entry(key))
    if fault is None or fault.tick >= ticks:
        return ""
    return (
        f"{name} is shown alone in “{scenario.title}”: {get_entry_title(key)} would end the run"
        f" earlier. {get_entry_title(key)}: {fault.message}"
    )


def _run(scenario: Scenario, entry: Entry) -> tuple[Fault | None, int]:
    result = simulate(entry.build_configuration(scenario), duration_s=scenario.duration_s)
    return result.fault, len(result.samples)
