"""Cost of a tick of a bench's loop called from Python, without I/O."""

import time
from typing import NamedTuple

import numpy as np

from svsa.actuators.signals import CHANNELS, MEASURED, TORQUES
from svsa.control.call import build_call
from svsa.control.installed import PAPERS_LAW, list_law_names
from svsa.control.law_names import AnyLaw
from svsa.evaluation.timing.turns import measure_in_turns
from svsa.numerics.packed import pack
from svsa.runs.definition.paper import get_figure
from svsa.runs.execution.run import Run
from svsa.runs.result.simulate import simulate
from svsa.simulation.loop.measured import (
    Actuation,
    BenchConstants,
    BenchLoopState,
    follow_and_decide,
    publish_and_predict,
)

FIGURE = "4a"
TICKS = 1000
RUN_S = 6.0
"""Duration of the run, up to 1 s after the load, s."""


class TickCost(NamedTuple):
    """Time of a tick under a law.

    Attributes:
        loop_us: Mean in the compiled loop including the plant, µs.
        median_us: Median of a bench's ticks, each called from Python, which takes most of the time,
            µs.
        worst_us: Maximum of a bench's ticks, µs.
    """

    loop_us: float
    median_us: float
    worst_us: float


class BenchTicks:
    """The loop of a bench under the law of a run, with that run's measurements.

    `samples` are (ticks, channels); `asked` is the torque of the law at the last tick, N·m, (2,).
    """

    def __init__(self, run: Run, samples: np.ndarray) -> None:
        self._run = run  # keeps the memory alive to which the call points
        call = build_call(run.laws[0], run.lanes[0].memory)
        self._constants = pack(BenchConstants(run.blocks[0], Actuation(0.0, 0.0), call))
        self._inputs, self._carried = run.inputs, pack(BenchLoopState())
        self._measured = self._carried["measured"].view(float).reshape(-1)
        self.limited = self._carried["limited"].view(float).reshape(-1)
        self._y, self._u = samples[:, MEASURED].copy(), samples[:, TORQUES].tolist()
        self._row, self._spring = np.empty(len(CHANNELS)), run.lanes[0].spring

    def run_tick(self, tick: int) -> float:
        """Run one tick; return its duration, s."""
        self._measured[:] = self._y[tick]
        u1, u2 = self._u[tick]
        begin = time.perf_counter_ns()
        follow_and_decide(self._constants, self._inputs, self._carried, tick)
        publish_and_predict(self._constants, self._carried, self._spring, u1, u2, tick, self._row)
        return 1e-9 * (time.perf_counter_ns() - begin)


def measure_law_tick(law: str = PAPERS_LAW, repeats: int = 5) -> TickCost:
    """Measure the cost of a tick under a law in Figure 4A with its load.

    Each tick counts with its minimum over the repetitions, because it does the same work each time
    and the rest is caused by the machine.
    """
    configuration = get_figure(FIGURE).build_configuration(law)
    samples = simulate(FIGURE, AnyLaw(law), duration_s=RUN_S).samples
    again = np.empty_like(samples)
    loop_s, least_s = np.inf, np.full(len(samples), np.inf)
    for _ in range(repeats):
        run = Run(configuration)
        begin = time.perf_counter()
        run.advance(again[None])
        loop_s = min(loop_s, time.perf_counter() - begin)
        ticks = BenchTicks(Run(configuration), samples)
        least_s = np.minimum(least_s, [ticks.run_tick(tick) for tick in range(len(samples))])
    return TickCost(
        loop_us=1e6 * loop_s / len(samples),
        median_us=1e6 * float(np.median(least_s)),
        worst_us=1e6 * float(np.max(least_s)),
    )


def measure_laws(repeats: int = 5) -> dict[str, TickCost]:
    """Measure the cost of a tick under each installed law."""
    return {law: measure_law_tick(law, repeats) for law in list_law_names()}


def measure_bench_tick(run: Run, repeats: int) -> float:
    """CPU time of a bench's tick, the mean of a thousand, s."""
    call = build_call(run.laws[0], run.lanes[0].memory)
    constants = pack(BenchConstants(run.blocks[0], Actuation(0.0005, 0.0), call))
    carried, row = pack(BenchLoopState()), np.empty(len(CHANNELS))

    def work() -> None:
        for tick in range(TICKS):
            follow_and_decide(constants, run.inputs, carried, tick)
            publish_and_predict(constants, carried, run.lanes[0].spring, 0.0, 0.0, tick, row)

    return measure_in_turns({"tick": work}, repeats)["tick"] / TICKS
