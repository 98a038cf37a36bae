"""The loads of a run: when each was on, by one rule for the run and its record."""

from collections.abc import Iterable

from svsa.simulation.plant.load_table import ScheduledLoad, continue_push, schedule_load
from svsa.simulation.plant.loads import Load

Loads = tuple[ScheduledLoad, ...]


def give_load(
    loads: Loads, number: int, load: Load, tick: int, period: float
) -> tuple[ScheduledLoad, Loads]:
    """One more load at a tick: as it is on then, and all loads with it.

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
    """Every load of a run, with the ticks at which it came and went.

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
