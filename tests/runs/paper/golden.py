"""Every channel of the paper's simulated figures, and of every law with every effect, as a hash.

python -m tests.runs.paper.golden [--figures] > tests/runs/paper/golden.json
--figures: the figures, and NDOBC alone of the laws.
"""

import hashlib
import json
import sys

import svsa
from svsa.actuators.signals import CHANNEL_NAMES
from svsa.control.installed import list_law_names
from svsa.simulation.plant.effects import EVERY

GENERIC = {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
"""The variables of a process that computes for the oldest processor of this machine's family.

numba keeps what it compiles for one kind of processor apart from what it compiles for another.
"""


Hashes = dict[str, str]
"""Hash of each channel."""


def compute_hashes(result: svsa.Result) -> Hashes:
    """Hash each channel at all ticks, as little-endian doubles."""
    columns = zip(CHANNEL_NAMES, result.samples.astype("<f8").T, strict=True)
    return {name: hashlib.sha256(column.tobytes()).hexdigest()[:16] for name, column in columns}


def compute_figures() -> dict[str, Hashes]:
    """Simulate Figures 4A, 4B and 5 with both laws."""
    return {
        f"{figure} {law}": compute_hashes(svsa.simulate(figure, law))
        for figure in ("4a", "4b", "5")
        for law in ("fl", "ndobc")
    }


def compute_law(law: str) -> Hashes:
    """Simulate Figure 4A with every effect, up to 1.5 s after its load."""
    return compute_hashes(svsa.simulate("4a", law, effects=EVERY, seed=7, duration_s=6.5))


def compute_laws() -> dict[str, Hashes]:
    """Simulate the same under every installed law."""
    return {law: compute_law(law) for law in list_law_names()}


if __name__ == "__main__":
    laws = {"ndobc": compute_law("ndobc")} if "--figures" in sys.argv else compute_laws()
    json.dump({"figures": compute_figures(), "laws": laws}, sys.stdout, indent=1)
    sys.stdout.write("\n")
