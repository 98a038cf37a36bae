"""`make bench`: the cost of a tick of the simulated loop, in CPU time."""

import time

import numpy as np

from svsa.experiment.paper import FIGURES
from svsa.runtime.run import Run
from svsa.signals import CHANNELS

TICKS = 200_000
REPEATS = 5


def measure_tick(figure: str, law: str) -> float:
    """CPU µs a tick, the best of a few runs of 20 s of session time."""
    samples = np.empty((1, 20_000, len(CHANNELS)))
    costs = []
    for _ in range(REPEATS):
        run = Run(FIGURES[figure].build_configuration(law))
        begin = time.process_time()
        for _ in range(TICKS // samples.shape[1]):
            run.advance(samples)
        costs.append((time.process_time() - begin) / TICKS * 1e6)
    return min(costs)


def main() -> None:
    """Print the cost for both laws on Figure 4A and 5."""
    measure_tick("4a", "fl")
    for figure in ("4a", "5"):
        for law in ("fl", "ndobc"):
            print(f"figure {figure:3} {law:6} {measure_tick(figure, law):.3f} µs CPU a tick")


if __name__ == "__main__":
    main()
