"""Many configurations at once, eight side by side: what a sweep of parameters is made of."""

from collections.abc import Sequence

import numpy as np

from svsa.control.installed import get_law
from svsa.lanes.record import lay_out_record
from svsa.loop.batch import SUMMARY, Batch, build_batch, run_batch
from svsa.loop.lane import Inputs, build_lane_state
from svsa.plant.disturbances import build_load_table
from svsa.reference.transition import build_stack
from svsa.run.blocks import build_blocks, build_constants, compute_start_ratio
from svsa.run.configuration import Configuration
from svsa.run.loads import follow_loads


def run_configurations(
    configurations: Sequence[Configuration], duration_s: float, begin_s: float = 0.0, steps: int = 1
) -> np.ndarray:
    """Every configuration's first lane from t = 0; an array (runs,) of `SUMMARY`, in their order.

    The same bits as a run of each by itself. begin_s: when measuring begins. steps: Runge–Kutta
    steps a period.
    """
    summaries = np.empty(len(configurations), dtype=SUMMARY)
    for numbers in _find_alike(configurations):
        chosen = [configurations[number] for number in numbers]
        period = chosen[0].sampling.period_s
        ticks, begin = round(duration_s / period), round(begin_s / period)
        summaries[numbers] = run_batch(build_run_batch(chosen, steps), ticks, begin)
    return summaries


def _find_alike(configurations: Sequence[Configuration]) -> list[list[int]]:
    """The numbers of those that go side by side."""
    alike: dict[tuple[object, ...], list[int]] = {}
    for number, c in enumerate(configurations):
        reaction = c.actuator.reaction_torque, c.nominal.reaction_torque
        switches = (c.lanes[0].law, c.sampling, c.effects.delay_samples, reaction)
        alike.setdefault((*switches, c.position, c.stiffness, c.loads), []).append(number)
    return list(alike.values())


def build_run_batch(configurations: Sequence[Configuration], steps: int = 1) -> Batch:
    """The first lanes of configurations of one law, under the references and loads of the first.

    Their sampling, delay and way of the reaction torque are the same.
    """
    law, c = get_law(configurations[0].lanes[0].law), configurations[0]
    blocks = [
        build_blocks(one, one.lanes[0], compute_start_ratio(one), steps) for one in configurations
    ]
    constants = [
        build_constants(one, one.lanes[0], b) for one, b in zip(configurations, blocks, strict=True)
    ]
    loads = build_load_table(follow_loads(c.loads, (), c.sampling.period_s))
    return build_batch(
        law.control,
        blocks,
        constants,
        [build_lane_state(law.start_memory())] * len(blocks),
        lay_out_record(law.memory()),
        Inputs(build_stack(c.position), build_stack(c.stiffness), loads),
    )
