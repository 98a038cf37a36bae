"""Measurements in turns, so that other load affects all of them equally."""

import time
from collections.abc import Callable, Mapping

import numpy as np


def measure_in_turns(works: Mapping[str, Callable[[], object]], repeats: int) -> dict[str, float]:
    """Return the minimum CPU time of each, s, after one uncounted run."""
    least = dict.fromkeys(works, np.inf)
    for turn in range(repeats + 1):
        for name, work in works.items():
            begin = time.process_time()
            work()
            if turn:
                least[name] = min(least[name], time.process_time() - begin)
    return least
