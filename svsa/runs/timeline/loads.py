"""Active loads of a run over time, by one rule for runs and records."""

from collections import deque
from collections.abc import Iterable, Iterator

from svsa.runs.definition.command import ApplyLoad, Command, RemoveLoad
from svsa.runs.definition.configuration import Configuration
from svsa.simulation.plant.load_table import ScheduledLoad, continue_push, schedule_load
from svsa.simulation.plant.loads import Load

Loads = tuple[ScheduledLoad, ...]


def give_load(
    loads: Loads, number: int, load: Load, tick: int, period: float, joint: int = 1
) -> tuple[ScheduledLoad, Loads]:
    """Add a load at a tick; return it with its absolute times, and all loads.

    A push while another one is active changes that one instead.

    Args:
        loads: The loads by number.
        number: Number for the new load.
        load: The load.
        tick: Current tick.
        period: Control period T, s.
        joint: Joint of an arm on which it acts.

    Returns:
        The load, and all loads.
    """
    held = continue_push(loads, load, tick, period)
    if held is not None:
        return held, tuple(held if other.number == held.number else other for other in loads)
    scheduled = schedule_load(number, load, tick, period)._replace(joint=joint)
    return scheduled, (*loads, scheduled)


def follow_loads(
    planned: Iterable[Load], changes: Iterable[tuple[int, Load | int]], period: float
) -> Loads:
    """List every load of a run, with its first and last tick.

    A push that was sent again is one load with its last values. Times do not depend on the joint of
    an arm: it is not followed, and `joint` of each load is 1.

    Args:
        planned: Loads of the configuration.
        changes: Tick, and the load applied or the number of the load removed.
        period: Control period T, s.

    Returns:
        The loads.
    """
    last = deque(trace_loads(planned, changes, period), maxlen=1)
    return last[0][1] if last else ()


def trace_loads(
    planned: Iterable[Load], changes: Iterable[tuple[int, Load | int]], period: float
) -> Iterator[tuple[int, Loads]]:
    """List the loads of a run after each change, each push with the values that it had then.

    Args:
        planned: Loads of the configuration.
        changes: Tick, and the load applied or the number of the load removed.
        period: Control period T, s.

    Yields:
        Tick of the change, and the loads.
    """
    loads: Loads = ()
    number = 0
    for tick, change in [*((0, load) for load in planned), *changes]:
        if isinstance(change, int):
            loads = tuple(_end(load, tick) if load.number == change else load for load in loads)
        else:
            number += 1
            _, loads = give_load(loads, number, change, tick, period)
        yield tick, loads


def list_loads(configuration: Configuration, commands: Iterable[Command]) -> Loads:
    """List every load of a run, with its first and last tick."""
    changes = _select_load_changes(commands)
    return follow_loads(configuration.planned_loads, changes, configuration.sampling.period_s)


def list_load_changes(
    configuration: Configuration, commands: Iterable[Command]
) -> list[tuple[int, Loads]]:
    """List the loads of a run after each change, with its tick; see `trace_loads`."""
    changes = _select_load_changes(commands)
    period = configuration.sampling.period_s
    return list(trace_loads(configuration.planned_loads, changes, period))


def _select_load_changes(commands: Iterable[Command]) -> list[tuple[int, Load | int]]:
    return [
        (command.tick, command.argument)
        for command in commands
        if isinstance(command, ApplyLoad | RemoveLoad)
    ]


def _end(load: ScheduledLoad, tick: int) -> ScheduledLoad:
    return load._replace(end_tick=min(load.end_tick, tick))
