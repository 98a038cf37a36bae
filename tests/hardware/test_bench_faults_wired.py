"""Faults whose causes come over the wire itself, with the emulator in a process of its own."""

import pytest

from svsa.hardware.emulator.launch import start_emulator
from tests.exhaustive import exhaust

from .caused_faults import CASES, check_stopped
from .watched_bench import make_ready


@pytest.mark.parametrize(
    "name",
    exhaust(
        ["no frames of motor1", "error frames", "a stranger resets the drives"],
        ["no frames of motor1"],
    ),
)
def test_over_sockets_it_ends_the_same(name: str) -> None:
    """As `test_bench_faults` has it in one process."""
    with start_emulator(lockstep=True) as emulator:
        bench = make_ready(emulator)
        try:
            bench.run()
            begin = bench.begin_watch()
            CASES[name].cause(bench)
            check_stopped(bench, CASES[name], begin)
        finally:
            bench.close()
