"""Start and end of an emulator in its own process."""

import contextlib
import re
import subprocess
import sys
from collections.abc import Iterator
from typing import NamedTuple

from svsa.hardware.emulator.control import EmulatorControl, EmulatorError

START_S = 60.0
_READY = re.compile(r"socketcand 127\.0\.0\.1:(\d+), slcan (\S+) (\S+), control 127\.0\.0\.1:(\d+)")


class RunningEmulator(NamedTuple):
    """Addresses of an emulator: socketcand port, two slcan terminals, control port."""

    port: int
    slcan: str
    second_slcan: str
    control_port: int
    control: EmulatorControl
    process: subprocess.Popen[str]


@contextlib.contextmanager
def start_emulator(
    lockstep: bool = True, idle_s: float = 120.0, *options: str
) -> Iterator[RunningEmulator]:
    """Start an emulator on free ports of this machine, ended with the block; raises
    `EmulatorError`.
    """
    command = [
        sys.executable,
        "-m",
        "svsa.hardware.emulator.cli",
        "--port",
        "0",
        "--control-port",
        "0",
    ]
    command += ["--idle-s", str(idle_s), *options, *(["--lockstep"] if lockstep else [])]
    # A separate process session: Ctrl-C reaches the program that uses the emulator first and does
    # not end the emulator while its bus is open.
    process = subprocess.Popen(  # noqa: S603
        command,
        stdout=subprocess.PIPE,
        stdin=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
    )
    try:
        if process.stdout is None:
            raise EmulatorError("The emulator has no output.")
        line = process.stdout.readline()
        match = _READY.search(line)
        if match is None:
            raise EmulatorError(f"The emulator did not start: {line.strip() or 'no output'}")
        with EmulatorControl(int(match[4])) as control:
            port, control_port = int(match[1]), int(match[4])
            yield RunningEmulator(port, match[2], match[3], control_port, control, process)
    finally:
        process.terminate()
        process.wait(START_S)
        if process.stdout is not None:
            process.stdout.close()
