"""Frames that the drives receive when processes of a bench are killed or stopped, in
emulator time.
"""

import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from svsa.hardware.emulator.launch import RunningEmulator
from svsa.simulation.plant.loads.constant import ConstantLoad
from tests.processes import find_child

LOOP, SUPERVISOR = "svsa.hardware.realtime.process", "svsa.hardware.safety.supervisor"
LOAD = ConstantLoad(torque_nm=(1.5, 0.0, 0.0))
PATIENCE_S = 60.0
ATTEMPTS = 3
SAID = "bench: "


class Outcome(NamedTuple):
    """before_ma: the last command of both drives before they held the load.

    zero_s: time from the signal to zero current, in the emulator's time. modes: the modes of the
    drives at the end, None after a reset.
    """

    before_ma: list[int]
    zero_s: float
    modes: list[int | None]


class StandingBench:
    """`standing_bench` as a process, and its child processes."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process
        line = self.read_line()
        assert line == "runs", line
        self.ids = {
            "server": process.pid,
            "loop": find_child(process.pid, LOOP),
            "supervisor": find_child(process.pid, SUPERVISOR),
        }

    def read_line(self) -> str:
        """Return its next line; empty after its end."""
        assert self._process.stdout is not None
        for line in self._process.stdout:
            if line.startswith(SAID):
                return line.removeprefix(SAID).strip()
        return ""

    def wait_for(self, code: str) -> None:
        """Wait until it reports this fault, which may follow another."""
        guard = threading.Timer(PATIENCE_S, self._process.kill)
        guard.start()
        said = []
        while not (said and said[-1].startswith(code)):
            said.append(self.read_line())
            assert said[-1], f"it said {said} and no {code}"
        guard.cancel()

    def wait_for_end(self) -> None:
        """Wait until neither loop nor supervisor runs."""
        end = time.monotonic() + PATIENCE_S
        while left := [one for one in ("loop", "supervisor") if find(self.ids[one]).exists()]:
            assert time.monotonic() < end, f"{left} goes on without its server"
            time.sleep(0.02)

    def signal(self, victims: tuple[str, ...], number: signal.Signals) -> None:
        for victim in victims:
            os.kill(self.ids[victim], number)


def find(process: int) -> Path:
    """Return the system's folder of a process, which exists while the process does."""
    return Path(f"/proc/{process}")


@contextlib.contextmanager
def run_standing_bench(path: Path, emulator: RunningEmulator) -> Iterator[StandingBench]:
    emulator.control.set_loads(())
    emulator.control.home()
    process = subprocess.Popen(
        [sys.executable, "-m", "tests.hardware.standing_bench", str(path)],
        cwd=Path(__file__).parents[3],
        stdout=subprocess.PIPE,
        text=True,
    )
    bench = None
    try:
        bench = StandingBench(process)
        emulator.control.load(LOAD)
        yield bench
    finally:
        for each in (bench.ids if bench else {"server": process.pid}).values():
            with contextlib.suppress(ProcessLookupError):
                os.kill(each, signal.SIGKILL)
        process.wait()
        assert process.stdout is not None
        process.stdout.close()


def read_currents(emulator: RunningEmulator) -> list[int]:
    """Return the currents of both drives, mA."""
    return [drive["commanded_ma"] for drive in emulator.control.read_state()["drives"].values()]


def wait_until_held(emulator: RunningEmulator) -> list[int]:
    """Return the currents with which both drives hold the load; none if the bench stops earlier.

    Shortly afterwards the current of motor 2, which is small, may pass through zero.
    """
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        state = emulator.control.read_state()
        currents = [drive["commanded_ma"] for drive in state["drives"].values()]
        if any(drive["mode"] is None for drive in state["drives"].values()):
            return []
        if abs(currents[0]) > 300 and abs(currents[1]) > 10 and abs(state["x"]["dq"]) < 0.05:
            return currents
        time.sleep(0.01)
    return []


def measure(
    emulator: RunningEmulator,
    path: Path,
    victims: tuple[str, ...],
    number: signal.Signals,
    codes: tuple[str, ...] = (),
) -> Outcome:
    """Bring the bench to hold a load, send the signal, wait for zero; repeat after an earlier stop.

    codes: the faults that the bench then reports; before the second of two faults, the signalled
    processes continue. Without the server the other processes end.
    """
    for _ in range(ATTEMPTS):
        with run_standing_bench(path, emulator) as bench:
            before = wait_until_held(emulator)
            if not before:
                continue
            signalled_s = emulator.control.read_state()["time_s"]
            bench.signal(victims, number)
            end = time.monotonic() + PATIENCE_S
            while any(read_currents(emulator)):
                assert time.monotonic() < end, (
                    f"{victims}: the drives hold {read_currents(emulator)}"
                )
                time.sleep(0.005)
            drives = emulator.control.read_state()["drives"].values()
            zero_s = max(drive["commanded_since_s"] for drive in drives) - signalled_s
            for code in codes:
                bench.wait_for(code)
                if len(codes) > 1:
                    bench.signal(victims, signal.SIGCONT)
            if "server" in victims and number == signal.SIGKILL:
                bench.wait_for_end()
            modes = [drive["mode"] for drive in emulator.control.read_state()["drives"].values()]
            return Outcome(before, zero_s, modes)
    raise AssertionError(f"The bench did not hold the load in {ATTEMPTS} attempts.")
