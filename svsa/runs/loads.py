"""The loads of a run: when each was on, by one rule for the run and its record, and its words."""

from collections.abc import Iterable, Sequence

from svsa.simulation.plant.loads import (
    PAPER_ARM_M,
    ConstantLoad,
    Load,
    MassLoad,
    PaperLoad,
    PulseLoad,
    PushLoad,
    ScheduledLoad,
    SineLoad,
    continue_push,
    schedule_load,
)

Loads = tuple[ScheduledLoad, ...]


def give_load(
    loads: Loads, number: int, load: Load, tick: int, period: float
) -> tuple[ScheduledLoad, Loads]:
    """One more load at a tick: as it is on then, and all loads with it.

    number: the one that it gets. A push told while one is on changes that one instead. period: s.
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
    the one taken off. A push that was told again is one load, as it was told last.
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


def describe_load(load: Load) -> str:
    """A load in a few words: "3 kg" (the paper's), "3 kg mass", "5 N·m", "pulse 5 N·m", "push"."""
    match load:
        case PaperLoad():
            return "3 kg"
        case MassLoad():
            arm = "" if load.arm_m == PAPER_ARM_M else f" at {1000 * load.arm_m:g} mm"
            return f"{load.mass_kg:g} kg mass{arm}"
        case ConstantLoad():
            return _format_torque(load.torque_nm)
        case PushLoad():
            return "push"
        case PulseLoad():
            return f"pulse {_format_torque(load.torque_nm)}"
        case SineLoad():
            return f"sine {_format_torque(load.torque_nm)} {load.frequency_hz:g} Hz"
    return "torque series"


def _format_torque(torque_nm: Sequence[float]) -> str:
    link, *motors = (f"{value:.3g}" for value in torque_nm)
    return f"{link} N·m" if not any(torque_nm[1:]) else f"{', '.join((link, *motors))} N·m"


def name_load(load: Load) -> str:
    """The words for a load at the beginning of a label: "3 kg load", "Push", "5 N·m"."""
    text = describe_load(load)
    return f"{text} load" if isinstance(load, PaperLoad) else text[:1].upper() + text[1:]
