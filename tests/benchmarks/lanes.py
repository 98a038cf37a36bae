"""`python -m tests.benchmarks.lanes`: CPU time a tick and lane, compiled and from Python."""

import time
from collections.abc import Callable

import numpy as np

import svsa
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.signals import CHANNELS
from svsa.control.installed import get_law
from svsa.control.laws.feedback_linearization import build_gains
from svsa.control.laws.ndobc import compute_ndobc
from svsa.runs.blocks import bind_law, build_blocks
from svsa.runs.configuration import Configuration
from svsa.runs.run import Run
from svsa.simulation.loop.lane import Inputs, build_lane_state
from svsa.simulation.loop.loop import advance_tick
from svsa.simulation.loop.stepwise import Controller
from svsa.simulation.plant.loads import build_load_table
from svsa.simulation.reference.transition import build_stack
from tests.runs.session.sessions import EVERY_EFFECT

REPEATS = 7
COMPILED_TICKS, PYTHON_TICKS = 20_000, 4_000
EFFECTS = {"ideal": svsa.IDEAL, "rig": svsa.RIG, "every effect": EVERY_EFFECT}


def build_configuration(effects: svsa.Effects, lanes: int) -> Configuration:
    """Figure 4A with its load, NDOBC in every lane."""
    configuration = svsa.paper.get_figure("4a").build_configuration()
    comparisons = (svsa.Lane(law="ndobc"),) * (lanes - 1)
    return configuration.changed(effects=effects, comparisons=comparisons)


def measure(work: Callable[[], int]) -> float:
    """CPU µs for each of the ticks that `work` says it did, the best of a few."""
    costs = []
    for _ in range(REPEATS):
        begin = time.process_time()
        ticks = work()
        costs.append((time.process_time() - begin) / ticks * 1e6)
    return min(costs)


def measure_compiled(effects: svsa.Effects, lanes: int) -> float:
    """µs a tick and lane of one call."""
    configuration = build_configuration(effects, lanes)
    samples = np.empty((lanes, COMPILED_TICKS, len(CHANNELS)))
    return measure(lambda: Run(configuration).advance(samples)) / lanes


def measure_single_ticks(effects: svsa.Effects) -> float:
    """µs a tick of `advance_tick`, called from Python for every tick."""
    configuration = build_configuration(effects, 1)
    stacks = build_stack(configuration.position), build_stack(configuration.stiffness)
    inputs = Inputs(*stacks, build_load_table(()))
    blocks = build_blocks(configuration, configuration.lanes[0], Run(configuration).mu0)
    law = bind_law(configuration, configuration.lanes[0], blocks)
    samples = np.empty((PYTHON_TICKS, len(CHANNELS)))

    def work() -> int:
        lane = build_lane_state(get_law("ndobc").start_memory())
        for tick, sample in enumerate(samples):
            lane, _ = advance_tick(blocks, law, inputs, lane, tick, sample)
        return PYTHON_TICKS

    return measure(work)


def measure_python_controller(effects: svsa.Effects, controller: Controller) -> float:
    """µs a tick of a run whose controller is plain Python."""
    configuration = build_configuration(effects, 1)
    samples = np.empty((1, PYTHON_TICKS, len(CHANNELS)))
    return measure(lambda: Run(configuration, controller=controller).advance(samples))


def build_python_ndobc() -> Controller:
    """NDOBC with the compiled equation, called from Python."""
    configuration = build_configuration(svsa.IDEAL, 1)
    nominal = build_actuator(configuration.nominal, Run(configuration).mu0)
    gains = build_gains(configuration.gains)
    return lambda time_s, reference, x, w: compute_ndobc(nominal, gains, x, reference, w)


def main() -> None:
    """Print all of them."""
    measure_compiled(svsa.IDEAL, 1)
    for name, effects in EFFECTS.items():
        for lanes in (1, 2, 3, 4):
            cost = measure_compiled(effects, lanes)
            print(f"compiled, {name:12} {lanes} lanes      {cost:7.3f} µs CPU a tick and lane")
    rest, ndobc = (lambda time_s, reference, x, w: (0.0, 0.0)), build_python_ndobc()
    for name, effects in EFFECTS.items():
        print(
            f"single ticks, {name:12}          {measure_single_ticks(effects):7.1f} µs CPU a tick"
        )
        cost = measure_python_controller(effects, rest)
        print(f"Python controller, {name:12}     {cost:7.1f} µs CPU a tick, controller for nothing")
        cost = measure_python_controller(effects, ndobc)
        print(f"Python controller, {name:12}     {cost:7.1f} µs CPU a tick, NDOBC")


if __name__ == "__main__":
    main()
