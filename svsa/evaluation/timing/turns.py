"""Works measured in turns, so that what else the machine does costs each of them the same."""

import time
from collections.abc import Callable, Mapping

import numpy as np


def measure_in_turns(works: Mapping[str, Callable[[], object]], repeats: int) -> dict[str, float]:
    """The least CPU time of each, s; every one once before, which does not count."""
    least = dict.fromkeys(works, np.inf)
    for turn in range(repeats + 1):
        for name, work in works.items():
            begin = time.process_time()
            work()
            if turn:
                least[name] = min(least[name], time.process_time() - begin)
    return least
