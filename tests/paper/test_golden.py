"""The same bits on every machine: x86-64 and aarch64, with or without wide registers or a fused
multiply-add.

A change of an equation changes these hashes: put in the new ones (`python -m
tests.paper.golden`), and say in the commit why. A change of numba, LLVM, libm or processor
that changes them is a fault.
"""

import json
import os
import subprocess
import sys

import pytest

from tests.paper.golden import GENERIC, compute_hashes

GOLDEN = {
    "4a fl": "4295a7170ec63857",
    "4a ndobc": "1dc184ca1fb295c0",
    "4b fl": "43f335d216854e97",
    "4b ndobc": "e64ff883f4b7724e",
    "5 fl": "520b1f49095804b0",
    "5 ndobc": "69bd60a887124460",
    "4a with every effect": "27647297f3e7ad68",
}


def test_every_sample_of_the_figures_is_what_it_was() -> None:
    assert compute_hashes() == GOLDEN


@pytest.mark.long
def test_a_processor_without_any_extension_computes_the_same() -> None:
    """Compiled for the oldest of this machine's family: on x86-64 without AVX and FMA."""
    answer = subprocess.run(
        [sys.executable, "-m", "tests.paper.golden"],
        env=os.environ | GENERIC,
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
    assert answer.returncode == 0, answer.stderr
    assert json.loads(answer.stdout) == GOLDEN
