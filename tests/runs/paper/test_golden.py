"""The same bits on every machine: x86-64 and aarch64, with or without wide registers or a fused
multiply-add.

A change of an equation changes these hashes: enter the new ones (`python -m
tests.runs.paper.golden`), and state the reason in the commit. If a change of numba, LLVM, libm or
processor changes them, it is a bug.
"""

import json
import os
import subprocess
import sys

import pytest

from svsa.control.installed import list_law_names
from tests.runs.paper.golden import GENERIC, compute_figures, compute_law

FIGURES = {
    "4a fl": "4295a7170ec63857",
    "4a ndobc": "1dc184ca1fb295c0",
    "4b fl": "43f335d216854e97",
    "4b ndobc": "e64ff883f4b7724e",
    "5 fl": "520b1f49095804b0",
    "5 ndobc": "69bd60a887124460",
}
LAWS = {
    "ndobc": "e1d0a8e204e452c5",
    "fl": "6206337e72673f6e",
    "adrc": "440d8645bf04ceb0",
    "backstepping": "00736b464852ef0b",
    "eso_saturated": "9114a87ce1de0379",
    "esp": "3525bc4770ebd8ac",
    "fl_integral": "f667e28e5063f142",
    "ilc": "e23cf3a3deb63eef",
    "linear_dob": "e83a2517b4a8ba85",
    "lqi": "7f8eddefb3c5e444",
    "ndobc_s": "dff42f8bba60effc",
    "ndobc_w": "448d27707e5d1e73",
    "nmpc": "db2a2551fa1bdd21",
    "pd": "182c33b62fb8b763",
    "pi_observer": "0517c5cd0831312a",
    "pid": "e0c7dec16057bd22",
    "prescribed_performance": "adc6b748d4822f8a",
    "rbf_network": "04cd54a8441e951e",
    "super_twisting": "e64071427e91b6da",
}


def test_samples_of_the_figures_match_their_hashes() -> None:
    assert compute_figures() == FIGURES


@pytest.mark.parametrize("law", list_law_names())
def test_samples_under_each_law_match_their_hashes(law: str) -> None:
    assert compute_law(law) == LAWS[law]


@pytest.mark.long
@pytest.mark.exhaustive
def test_processor_without_extensions_computes_the_same() -> None:
    """Compiled for the oldest of this machine's family: on x86-64 without AVX and FMA."""
    answer = subprocess.run(
        [sys.executable, "-m", "tests.runs.paper.golden", "--figures"],
        env=os.environ | GENERIC,
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
    assert answer.returncode == 0, answer.stderr
    assert json.loads(answer.stdout) == {"figures": FIGURES, "laws": {"ndobc": LAWS["ndobc"]}}
