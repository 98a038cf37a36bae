"""Every sample of the paper's simulated figures, and of one run with every effect, as a hash.

python -m tests.paper.golden
"""

import hashlib
import json
import sys

import svsa
from svsa.plant.effects import EVERY

GENERIC = {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
"""The variables of a process that computes for the oldest processor of this machine's family.

numba keeps what it compiles for one kind of processor apart from what it compiles for another.
"""


def compute_hash(result: svsa.Result) -> str:
    """Of all channels at all ticks, as little-endian doubles."""
    return hashlib.sha256(result.samples.astype("<f8").tobytes()).hexdigest()[:16]


def compute_hashes() -> dict[str, str]:
    """Of Figures 4A, 4B and 5 with both laws, and of 4A with every effect."""
    hashes = {
        f"{figure} {law}": compute_hash(svsa.simulate(figure, law))
        for figure in ("4a", "4b", "5")
        for law in ("fl", "ndobc")
    }
    run = svsa.simulate("4a", "ndobc", effects=EVERY, seed=7, duration_s=8.0)
    return hashes | {"4a with every effect": compute_hash(run)}


if __name__ == "__main__":
    json.dump(compute_hashes(), sys.stdout)
