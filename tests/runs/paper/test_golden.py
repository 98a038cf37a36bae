"""The same bits on every machine: x86-64 and aarch64, with or without wide registers or a fused
multiply-add.

A change of an equation changes hashes in `golden.json`: write it again (`python -m
tests.runs.paper.golden`), and state the reason in the commit. A new channel adds its own hashes and
changes no other. If a change of numba, LLVM, libm or processor changes them, it is a bug.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from svsa.evaluation.ranking.results import load_published
from tests.runs.paper.golden import GENERIC, Hashes, compute_figures, compute_law

GOLDEN = json.loads(Path(__file__).with_name("golden.json").read_text())


def expect_golden(computed: Hashes, golden: Hashes) -> None:
    """A channel that was added later has no hash yet; every other one is compared."""
    assert {name: computed.get(name) for name in golden} == golden


def test_samples_of_the_figures_match_their_hashes() -> None:
    figures = compute_figures()
    assert figures.keys() == GOLDEN["figures"].keys()
    for name, hashes in figures.items():
        expect_golden(hashes, GOLDEN["figures"][name])


def test_every_ranked_law_has_hashes() -> None:
    assert {row.law for row in load_published().rows} <= GOLDEN["laws"].keys()


@pytest.mark.parametrize("law", GOLDEN["laws"])
def test_samples_under_each_law_match_their_hashes(law: str) -> None:
    expect_golden(compute_law(law), GOLDEN["laws"][law])


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
    computed = json.loads(answer.stdout)
    assert computed["laws"].keys() == {"ndobc"}
    for kind, runs in computed.items():
        for name, hashes in runs.items():
            expect_golden(hashes, GOLDEN[kind][name])
