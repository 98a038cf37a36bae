"""Active loads of a run over time, by one rule for runs and records."""

from collections.abc import Iterable

from svsa.simulation.plant.load_table import ScheduledLoad, continue_push, schedule_load
from svsa.simulation.plant.loads import Load

Loads = tuple[ScheduledLoad, ...]


def give_load(
    loads: Loads, number: int, load: Load, tick: int, period: float
) -> tuple[ScheduledLoad, Loads]:
    """Add a load at a tick; return it with its absolute times, and all loads.

    number: the one that it gets. A push sent while one is on changes that one instead. period: s.
    """
    held = continue_push(loads, load, tick, period)
    if held is not None:
        return held, tuple(held if one.number == held.number else one for one in loads)
    scheduled = schedule_load(number, load, tick, period)
    return scheduled, (*loads, scheduled)


def follow_loads(
    planned: Iterable[Load], changes: Iterable[tuple[int, Load | int]], period: float
) -> Loads:
    """List every load of a run, with its first and last tick.

    planned: those of its configuration. changes: tick, and the load applied or the number of
    the one removed. A push that was sent again is one load, as it was sent last.
    """
    loads: Loads = ()
    number = 0
    for tick, change in [*((0, load) for load in planned), *changes]:
        if isinstance(change, int):
            loads = tuple(_end(one, tick) if one.number == change else one for one in loads)
        else:
            number += 1
            _, loads = give_load(loads, number, change, tick, period)
    return loads


def _end(load: ScheduledLoad, tick: int) -> ScheduledLoad:
    return load._replace(end_tick=min(load.end_tick, tick))
