"""Events of a run, live or recorded, as text."""

from collections.abc import Iterable
from dataclasses import dataclass

from svsa.actuators.faults import label_fault
from svsa.control.installed import LawName, get_title
from svsa.errors import Fault
from svsa.runs.command import ApplyLoad, Command, RemoveLoad, Set
from svsa.runs.configuration import Configuration
from svsa.runs.replay import list_loads
from svsa.simulation.plant.loads import Load


@dataclass(frozen=True)
class Event:
    """An event: time, kind and label."""

    tick: int
    time_s: float
    kind: str
    label: str


def list_events(
    configuration: Configuration,
    commands: Iterable[Command],
    fault: Fault | None = None,
    reported: Iterable[Event] = (),
) -> list[Event]:
    """List the events of a run with these commands, in order of time.

    A load that comes and goes is one event each, whether it was planned or commanded; one that
    never ends has an end at no tick of the run. fault: what the run ended in, or None. reported:
    what a bench said of itself meanwhile.
    """
    commands, law = list(commands), configuration.law
    found: list[tuple[float, str, str]] = []
    for command in commands:
        if not isinstance(command, ApplyLoad | RemoveLoad):
            found.append((command.tick, command.kind, describe_change(command, law)))
            law = find_law(command) or law
    for _, load, start, end in list_loads(configuration, commands):
        if start < end:
            found.append((start, "load_on", describe_onset(load)))
            found.append((end, "load_off", describe_end(load)))
    found += [(event.tick, event.kind, event.label) for event in reported]
    if fault is not None:
        found.append((fault.tick, "fault", label_fault(fault.code)))
    period_s = configuration.sampling.period_s
    return [
        Event(int(tick), tick * period_s, kind, label)
        for tick, kind, label in sorted(found, key=lambda one: one[0])
        if tick < float("inf")
    ]


def find_law(command: Command) -> LawName | None:
    """Return the law that a command gives to the first lane, or None."""
    match command:
        case Set(kind="law", argument=law) | Set(kind="laws", argument=(law, *_)):
            return law
    return None


def describe_change(command: Command, law: LawName) -> str:
    """Describe a change in a few words; law: previous law of the first lane."""
    given = find_law(command)
    if given is not None and given != law:
        return f"{get_title(law)} → {get_title(given)}"
    match command:
        case Set(kind="lane", argument=argument):
            return f"{get_title(argument.setting.law)} set"
        case Set(kind="comparisons", argument=()):
            return "Comparison off"
        case Set(kind="comparisons", argument=comparisons):
            return f"{', '.join(get_title(lane.law) for lane in comparisons)} added"
    return command.label


def describe_onset(load: Load) -> str:
    """Describe the onset of a load."""
    return f"{load.name()} on"


def describe_end(load: Load) -> str:
    """Describe the end or the removal of a load."""
    return f"{load.name()} off"
