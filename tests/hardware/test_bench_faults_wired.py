"""Faults whose causes come over the wire itself, with the rig in a process of its own."""

import pytest

from svsa.hardware.emulator.launch import start_rig
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
    with start_rig(lockstep=True) as rig:
        bench = make_ready(rig)
        try:
            bench.run()
            begin = bench.begin_watch()
            CASES[name].cause(bench)
            check_stopped(bench, CASES[name], begin)
        finally:
            bench.close()
