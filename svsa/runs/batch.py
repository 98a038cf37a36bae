"""Many configurations at once, eight side by side: what a sweep of parameters is made of."""

from collections.abc import Sequence

import numpy as np

from svsa.control.installed import get_law
from svsa.numerics.simd.record import lay_out_record
from svsa.runs.blocks import bind_law, build_blocks, build_constants, compute_start_ratio
from svsa.runs.configuration import Configuration
from svsa.runs.loads import follow_loads
from svsa.simulation.loop.batch import Batch, build_batch, run_batch
from svsa.simulation.loop.batch_law import is_for_vectors
from svsa.simulation.loop.lane import Inputs
from svsa.simulation.loop.tally import SUMMARY
from svsa.simulation.plant.loads import LoadTable, build_load_table
from svsa.simulation.reference.trajectories import Trajectory
from svsa.simulation.reference.transition import Stack, build_stack


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
        switches = c.law, c.sampling.period_s, c.effects.delay_samples, *reaction
        alike.setdefault(switches, []).append(number)
    return list(alike.values())


def build_run_batch(configurations: Sequence[Configuration], steps: int = 1) -> Batch:
    """The first lanes of configurations of one law, each under its own references and loads.

    Their sampling, delay and way of the reaction torque are the same.
    """
    law = get_law(configurations[0].law)
    lanes = [(one, one.lanes[0]) for one in configurations]
    blocks = [build_blocks(c, lane, compute_start_ratio(c), steps) for c, lane in lanes]
    parts = list(zip(lanes, blocks, strict=True))
    first = build_constants(*lanes[0], blocks[0])
    inputs = _build_inputs(configurations)
    if is_for_vectors(law.control, blocks[0].nominal, first, lay_out_record(law.memory())):
        constants = [build_constants(*lane, own) for lane, own in parts]
        return build_batch(law, blocks, constants, (), inputs)
    return build_batch(law, blocks, (), [bind_law(*lane, own) for lane, own in parts], inputs)


def _build_inputs(configurations: Sequence[Configuration]) -> list[Inputs]:
    """The references and loads of each; built once where they are the same values."""
    stacks: dict[int, Stack] = {}
    tables: dict[tuple[int, ...], LoadTable] = {}

    def find_stack(trajectory: Trajectory) -> Stack:
        if id(trajectory) not in stacks:
            stacks[id(trajectory)] = build_stack(trajectory)
        return stacks[id(trajectory)]

    def find_table(c: Configuration) -> LoadTable:
        key = tuple(map(id, c.loads))
        if key not in tables:
            tables[key] = build_load_table(follow_loads(c.loads, (), c.sampling.period_s))
        return tables[key]

    return [
        Inputs(find_stack(c.position), find_stack(c.stiffness), find_table(c))
        for c in configurations
    ]
