"""The sum of the loads at the tip of an arm, as the 3D view draws it."""

import math
from collections.abc import Iterable, Sequence

import numpy as np

from svsa.runs.definition.command import Command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.timeline.loads import list_load_changes
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.tip import DAMPING, FORCE_X, FORCE_Y, AnyTipLoad
from svsa.simulation.plant.loads.tip import Wall as WallLoad
from svsa_scene.arm_pose import TipLoad, Wall


def sum_tip_loads(loads: Iterable[Load]) -> TipLoad:
    """Sum the loads that act at one instant; of several walls, the first."""
    acting = list(loads)
    forces = [_compute_force(load) for load in acting]
    walls = [load for load in acting if isinstance(load, WallLoad)]
    return TipLoad(
        mass_kg=sum(load.get_hung_mass() for load in acting),
        force_n=(sum(x for x, _ in forces), sum(y for _, y in forces)),
        wall=Wall(walls[0].normal_rad, walls[0].distance_m) if walls else None,
    )


def trace_tip_loads(
    configuration: Configuration, commands: Sequence[Command], first_tick: int
) -> list[tuple[int, TipLoad]]:
    """Trace the sum through a run.

    Args:
        configuration: Configuration of the run at tick 0.
        commands: Commands of the run.
        first_tick: Tick of the run that the result counts as 0.

    Returns:
        Each sum with the tick from which it acts, in the order of the ticks.
    """
    changes = list_load_changes(configuration, commands)
    sums = [(0, TipLoad())]
    ends = [*(tick for tick, _ in changes[1:]), math.inf]
    for (tick, loads), following in zip(changes, ends, strict=False):
        times = {time for held in loads for time in (held.start_tick, held.end_tick)}
        between = (int(time) for time in times if tick < time < following)
        for at in sorted({tick, *between}):
            load = sum_tip_loads(held.load for held in loads if held.is_on(at))
            if load != sums[-1][1]:
                sums.append((max(0, at - first_tick), load))
    return sums


def _compute_force(load: Load) -> tuple[float, float]:
    """Compute the force of a load at the tip, N; zero for a load on a joint."""
    row = np.zeros(DAMPING + 1)
    if isinstance(load, AnyTipLoad):
        load.fill_tip(row, load.get_duration())
    x, y = row[FORCE_X : FORCE_Y + 1].tolist()
    return x, y
