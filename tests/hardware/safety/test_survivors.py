"""Two of three are enough: what is left of loop, supervisor and server stops the drives.

The tests use real processes, signals that a process cannot ignore, and the emulator's own clock.
They report the time to zero current (`pytest -rP`), and assert that the current becomes zero.
"""

import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from svsa.hardware.description.file import read_bench
from svsa.hardware.emulator.launch import RunningEmulator, start_emulator
from tests.exhaustive import exhaust
from tests.hardware.live_bench import write_bench
from tests.hardware.wired_bench import EMULATOR_BENCH

from .survivors import PATIENCE_S, measure

KILL, STOP = signal.SIGKILL, signal.SIGSTOP
CASES = [
    (KILL, ("loop",), ("loop_lost",)),
    (KILL, ("supervisor",), ("supervisor_lost",)),
    (KILL, ("server",), ()),
    (KILL, ("loop", "supervisor"), ("loop_and_supervisor_lost",)),
    (KILL, ("loop", "server"), ()),
    (KILL, ("supervisor", "server"), ()),
    (STOP, ("loop",), ("loop_silent", "loop_late")),
    (STOP, ("supervisor",), ("supervisor_lost",)),
    (STOP, ("server",), ()),
    (STOP, ("loop", "supervisor"), ("loop_and_supervisor_lost",)),
]
SHOWN = [case for case in CASES if case[:2] == (KILL, ("loop", "server"))]
"""A supervisor alone; `test_bench_loss` tests a server alone."""

_SAFETY = read_bench(EMULATOR_BENCH).safety
WAITS = {name: getattr(_SAFETY, name) for name in ("loop_s", "supervisor_s", "server_s")}
"""The processes have the timeouts of a bench, which are measured here."""
pytestmark = pytest.mark.wall_clock


@pytest.fixture(scope="module")
def emulator() -> Iterator[RunningEmulator]:
    with start_emulator(lockstep=False, idle_s=600.0) as running:
        yield running


@pytest.mark.smoke
@pytest.mark.parametrize(
    "case", exhaust(CASES, SHOWN), ids=lambda case: f"{case[0].name}-{'-'.join(case[1])}"
)
def test_remaining_processes_stop_the_drives(
    emulator: RunningEmulator,
    tmp_path: Path,
    case: tuple[signal.Signals, tuple[str, ...], tuple[str, ...]],
) -> None:
    number, victims, codes = case
    bench = write_bench(tmp_path, emulator, lockstep=False, **WAITS)
    outcome = measure(emulator, bench, victims, number, codes)
    what = f"{number.name} {' + '.join(victims)}"
    sys.stdout.write(f"{what}: {1e3 * outcome.zero_s:.1f} ms to zero current")
    assert all(outcome.before_ma), "both drives held a current"
    assert 0.0 < outcome.zero_s < PATIENCE_S
    if (number, victims) == (KILL, ("server",)):
        assert outcome.modes == [None, None], "reset, where no user is left"
