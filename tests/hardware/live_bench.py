"""The bench file of an emulator in a separate process, on a machine that may be busy."""

import contextlib
import tomllib
from pathlib import Path
from typing import Any

import tomli_w

from svsa.actuators.parameters import SVSA
from svsa.hardware.emulator import bench_file
from svsa.hardware.emulator.launch import RunningEmulator, start_emulator
from svsa.hardware.emulator.parameters import build_emulator_parameters

PATIENT = {"loop_s": 1.0, "supervisor_s": 2.0, "server_s": 60.0}
"""Timeout of the processes of a bench for one another."""
LATE = {"stale_zero_s": 0.9, "stale_fault_s": 1.0, "missed_ticks": 900}
"""Also these, against the clock only: for an emulator or a loop that is not scheduled. The bench
must be at rest meanwhile: motion on feedback this old soon reaches the velocity limit.
"""

START_SILENCE_S, IDLE_S = 300.0, 600.0
"""A loop may start later on a busy machine than on a bench, and an emulator waits longer."""
STALL_S = PATIENT["loop_s"]
"""The machine may be suspended for this time: no user detects it, and the emulator waits."""


def start_live_emulator(
    actuator: str = SVSA,
) -> contextlib.AbstractContextManager[RunningEmulator]:
    """Start an emulator in lockstep with a loop in real time, with the loop's CPU priority.

    The emulator waits for the loop, so it is never late on a busy machine. Without a loop its time
    continues; tests that end the loop need this.
    """
    options = "--real-time", "--alone-s", str(STALL_S), "--actuator", actuator
    return start_emulator(True, IDLE_S, *options)


def write_bench(
    folder: Path,
    emulator: RunningEmulator,
    lockstep: bool = True,
    actuator: str = SVSA,
    **safety: Any,
) -> Path:
    """Write the bench file with the ports of this emulator, and its calibration record next to it.

    lockstep, actuator: those with which the emulator was started. safety: settings that differ from
    the timeouts that it needs.
    """
    path, parameters = folder / "bench.toml", build_emulator_parameters(actuator)
    bench_file.write_bench(path, parameters, emulator.port, emulator.control_port, lockstep)
    bench: dict[str, Any] = tomllib.loads(path.read_text(encoding="utf-8"))
    bench.setdefault("timing", {})["start_silence_s"] = START_SILENCE_S
    bench["safety"] |= PATIENT | ({} if lockstep else LATE) | safety
    path.write_text(tomli_w.dumps(bench), encoding="utf-8")
    return path
