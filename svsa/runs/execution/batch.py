"""Vectorised runs: many configurations at once, eight in parallel, for sweeps of parameters."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from svsa.actuators.parameters import MechanismParameters, get_mechanism_name
from svsa.control.installed import get_law
from svsa.control.observers.disturbance import compute_shares
from svsa.numerics.simd.record import lay_out_record
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Design, Lane
from svsa.runs.execution.blocks import build_blocks, build_setting, compute_start_ratio
from svsa.runs.timeline.loads import follow_loads
from svsa.simulation.loop.batch import Batch, build_batch, run_batch
from svsa.simulation.loop.batch_inputs import join_inputs
from svsa.simulation.loop.batch_law import is_for_vectors
from svsa.simulation.loop.batch_stepwise import GroupController, run_batch_stepwise
from svsa.simulation.loop.lane import Blocks, Inputs
from svsa.simulation.loop.tally import SUMMARY
from svsa.simulation.plant.load_table import LoadTable, build_load_table
from svsa.simulation.reference.kinds.reference import AnyReference
from svsa.simulation.reference.transition import Stack, build_stack


def run_configurations(
    configurations: Sequence[Configuration], duration_s: float, begin_s: float = 0.0, steps: int = 1
) -> np.ndarray:
    """Run every configuration's first lane from t = 0, bit-identical to separate runs.

    Args:
        configurations: The runs.
        duration_s: Duration, s.
        begin_s: Time at which measuring begins, s.
        steps: Runge–Kutta steps per period.

    Returns:
        An array (runs,) of `SUMMARY`.
    """
    summaries = np.empty(len(configurations), dtype=SUMMARY)
    for numbers in find_alike(configurations):
        chosen = [configurations[number] for number in numbers]
        period = chosen[0].sampling.period_s
        ticks, begin = round(duration_s / period), round(begin_s / period)
        summaries[numbers] = run_batch(build_run_batch(chosen, steps), ticks, begin)
    return summaries


def run_group(
    configurations: Sequence[Configuration],
    controller: GroupController,
    duration_s: float,
    begin_s: float = 0.0,
) -> np.ndarray:
    """Run at most eight compatible configurations (see `find_alike`) with a plain Python
    controller.

    Args:
        configurations: The runs; their laws are not used.
        controller: Called once per tick for all of them.
        duration_s: Duration from t = 0, s.
        begin_s: Time at which measuring begins, s.

    Returns:
        An array (runs,) of `SUMMARY`, in the order of the configurations.

    Raises:
        BaseException: What the controller raises.
    """
    part = _build_part(configurations, 1)
    period = part.blocks[0].period
    ticks, begin = round(duration_s / period), round(begin_s / period)
    return run_batch_stepwise(part.blocks, part.inputs, controller, ticks, begin)


def find_alike(configurations: Sequence[Configuration]) -> list[list[int]]:
    """Find the configurations that can run together, by number."""
    alike: dict[tuple[object, ...], list[int]] = {}
    for number, c in enumerate(configurations):
        kinds = _find_kind(c.actuator), _find_kind(c.nominal)
        switches = c.law, c.sampling.period_s, c.effects.delay_samples, *kinds
        alike.setdefault(switches, []).append(number)
    return list(alike.values())


def _find_kind(actuator: MechanismParameters) -> tuple[str, str]:
    """Return the part of an actuator that the machine code depends on."""
    return get_mechanism_name(actuator), getattr(actuator, "reaction_torque", "")


class RunSet:
    """Configurations that run together under any law and design; shared inputs are built once.

    The laws, gains, observers and parameters of the configurations are not used.
    """

    def __init__(self, configurations: Sequence[Configuration], steps: int = 1) -> None:
        self.count = len(configurations)
        self._parts = [
            (numbers, _build_part([configurations[number] for number in numbers], steps))
            for numbers in find_alike(configurations)
        ]

    def run(
        self, law: str, duration_s: float, begin_s: float = 0.0, design: Design | None = None
    ) -> np.ndarray:
        """Run all from t = 0.

        Args:
            law: Name of the law.
            duration_s: Duration, s.
            begin_s: Time at which measuring begins, s.
            design: Gains, observer and parameters; if left out, those of each configuration.

        Returns:
            An array (runs,) of `SUMMARY`.
        """
        summaries = np.empty(self.count, dtype=SUMMARY)
        for numbers, part in self._parts:
            period = part.blocks[0].period
            ticks, begin = round(duration_s / period), round(begin_s / period)
            summaries[numbers] = run_batch(part.bind(law, design), ticks, begin)
        return summaries


class _Part(NamedTuple):
    """Configurations of one batch, with their first lanes' blocks and joined inputs."""

    configurations: Sequence[Configuration]
    blocks: Sequence[Blocks]
    inputs: Inputs

    def bind(self, law: str, design: Design | None = None) -> Batch:
        """The batch under a law."""
        installed, lane, blocks = get_law(law), Lane(law=law), self.blocks
        designs: Sequence[Design] = self.configurations
        if design is not None:
            designs = [design] * len(blocks)
            shares = compute_shares(design.observer, blocks[0].period)
            blocks = [block._replace(shares=shares) for block in blocks]
        arguments = [
            (configuration.get_parameters(lane), build_setting(own))
            for configuration, own in zip(designs, blocks, strict=True)
        ]
        first = installed.build(*arguments[0])
        if is_for_vectors(
            installed.control, blocks[0].nominal, first, lay_out_record(installed.memory())
        ):
            constants = [installed.build(*pair) for pair in arguments]
            return build_batch(installed, blocks, constants, (), self.inputs)
        bound = [installed.bind(*pair) for pair in arguments]
        return build_batch(installed, blocks, (), bound, self.inputs)


def build_run_batch(configurations: Sequence[Configuration], steps: int = 1) -> Batch:
    """Build the first lanes of configurations of one law, each with its references and loads.

    The configurations have the same sampling, delay and form of the reaction torque.
    """
    return _build_part(configurations, steps).bind(configurations[0].law)


def _build_part(configurations: Sequence[Configuration], steps: int) -> _Part:
    blocks = [build_blocks(c, c.lanes[0], compute_start_ratio(c), steps) for c in configurations]
    return _Part(configurations, blocks, join_inputs(_build_inputs(configurations)))


def _build_inputs(configurations: Sequence[Configuration]) -> list[Inputs]:
    """Build references and loads of each run; equal ones are built once."""
    stacks: dict[int, Stack] = {}
    tables: dict[tuple[int, ...], LoadTable] = {}

    def find_stack(trajectory: AnyReference) -> Stack:
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
