"""Events of a run, live or recorded, as text."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from svsa.actuators.faults import label_fault
from svsa.control.installed import LawName, get_title
from svsa.errors import Fault
from svsa.runs.definition.command import ApplyLoad, Command, RemoveLoad, Set
from svsa.runs.definition.configuration import Configuration
from svsa.runs.timeline.loads import list_loads
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
    bench_events: Iterable[Event] = (),
) -> list[Event]:
    """List the events of a run with these commands, in order of time.

    Onset and end of a load are one event each, whether it was planned or commanded; a load without
    an end has its end at no tick of the run.

    Args:
        configuration: Configuration at tick 0.
        commands: Commands of the run.
        fault: Fault at the end of the run, or None.
        bench_events: Events that a bench reported.

    Returns:
        The events.
    """
    commands, laws = list(commands), list_laws(configuration)
    entries: list[tuple[float, str, str]] = []
    for command in commands:
        if not isinstance(command, ApplyLoad | RemoveLoad):
            entries.append((command.tick, command.kind, describe_change(command, laws)))
            if (law := find_law(command)) is not None:
                laws = [
                    law if command.joint in (None, number) else held
                    for number, held in enumerate(laws, start=1)
                ]
    for _, load, start, end, _ in list_loads(configuration, commands):
        if start < end:
            entries.append((start, "load_on", describe_onset(load)))
            entries.append((end, "load_off", describe_end(load)))
    entries += [(event.tick, event.kind, event.label) for event in bench_events]
    if fault is not None:
        entries.append((fault.tick, "fault", label_fault(fault.code)))
    period_s = configuration.sampling.period_s
    return [
        Event(int(tick), tick * period_s, kind, label)
        for tick, kind, label in sorted(entries, key=lambda entry: entry[0])
        if tick < float("inf")
    ]


def find_law(command: Command) -> LawName | None:
    """Return the law that a command gives to the first lane, or None."""
    match command:
        case Set(kind="law", argument=law) | Set(kind="laws", argument=(law, *_)):
            return law
    return None


def list_laws(configuration: Configuration) -> list[LawName]:
    """List the law of the first lane of each joint."""
    return [joint.law for joint in configuration.joints]


def describe_change(command: Command, laws: Sequence[LawName]) -> str:
    """Describe a change in a few words; `laws` are the previous ones, see `list_laws`."""
    if command.joint is not None:
        alone = describe_change(command.of_joint(None), laws[command.joint - 1 :])
        return f"Joint {command.joint}: {alone}"
    new_law = find_law(command)
    if new_law is not None and new_law != laws[0]:
        return f"{get_title(laws[0])} → {get_title(new_law)}"
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
