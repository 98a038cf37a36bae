"""Runs per second of a batch: with each non-ideal effect, and on two cores."""

import time
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import numpy as np

from svsa.evaluation.timing.turns import measure_in_turns
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.batch import build_run_batch
from svsa.simulation.loop.batch import Batch, run_batch
from svsa.simulation.plant.effects import EFFECTS, EVERY, IDEAL, RIG, Effects

SWITCHED: Mapping[str, Effects] = {
    "ideal": IDEAL,
    **{
        effect.name: Effects(**{effect.name: effect.on})
        for effect in EFFECTS
        if effect.on is not None
    },
    "estimation": Effects(encoders=RIG.encoders, estimation=RIG.estimation),
    "rig": RIG,
    "every": EVERY,
}
"""Effects that are on, by name. The estimation is that with encoders."""


def measure_effects(
    configuration: Configuration, lanes: int, duration_s: float, repeats: int
) -> dict[str, float]:
    """Measure runs per second and core, by CPU time, for each of `SWITCHED`.

    Ticks are counted: a run that ends in a fault counts only for its simulated part.
    """
    ticks = round(duration_s / configuration.sampling.period_s)
    batches = {
        name: build_run_batch([configuration.changed(effects=effects)] * lanes)
        for name, effects in SWITCHED.items()
    }
    runs = {name: run_batch(batch, ticks)["ticks"].sum() / ticks for name, batch in batches.items()}
    works = {name: partial(run_batch, batch, ticks) for name, batch in batches.items()}
    cost = measure_in_turns(works, repeats)
    return {name: float(runs[name] / cost[name]) for name in batches}


def measure_two_cores(batch: Batch, ticks: int, repeats: int) -> float:
    """Measure the speed-up of two threads over one; the best of several.

    Uses the wall clock, alternating with one thread; the result is valid only on two idle cores.
    """
    alone = together = np.inf
    with ThreadPoolExecutor(2) as pool:
        for _ in range(repeats + 1):
            begin = time.perf_counter()
            pool.submit(run_batch, batch, ticks).result()
            alone = min(alone, time.perf_counter() - begin)
            begin = time.perf_counter()
            futures = [pool.submit(run_batch, batch, ticks) for _ in range(2)]
            for future in futures:
                future.result()
            together = min(together, time.perf_counter() - begin)
    return float(2.0 * alone / together)
