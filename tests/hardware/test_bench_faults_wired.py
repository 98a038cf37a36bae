"""Faults with causes on the wire, with the emulator in a separate process."""

import pytest

from svsa.hardware.emulator.launch import start_emulator

from .caused_faults import CASES, check_stopped
from .watched_bench import make_ready


@pytest.mark.exhaustive
@pytest.mark.parametrize(
    "name", ["no frames of motor1", "error frames", "a stranger resets the drives"]
)
def test_faults_over_sockets_have_the_same_outcome(name: str) -> None:
    """As in `test_bench_faults` in one process."""
    with start_emulator(lockstep=True) as emulator:
        bench = make_ready(emulator)
        try:
            bench.run()
            begin = bench.begin_watch()
            CASES[name].cause(bench)
            check_stopped(bench, CASES[name], begin)
        finally:
            bench.close()
