"""The bench file of an emulator that is a process of its own, on a machine that may be busy."""

import contextlib
import tomllib
from pathlib import Path
from typing import Any

import tomli_w

from svsa.hardware.emulator.launch import RunningEmulator, start_emulator

from .wired_bench import EMULATOR_BENCH

PATIENT = {"loop_s": 1.0, "supervisor_s": 2.0, "server_s": 60.0}
"""How long the processes of a bench wait for one another."""
LATE = {"stale_zero_s": 0.9, "stale_fault_s": 1.0, "missed_ticks": 900}
"""Also these, against the clock only: an emulator that is not let run, or a loop. It has to stand
still meanwhile: what moves on feedback this old is soon as fast as it may be."""

START_SILENCE_S, IDLE_S = 300.0, 600.0
"""A loop may start later on a busy machine than on a bench, and an emulator waits longer."""
STALL_S = PATIENT["loop_s"]
"""The machine may stand still for so long: no user misses a loop, and the emulator waits for it."""


def start_live_emulator() -> contextlib.AbstractContextManager[RunningEmulator]:
    """An emulator in lockstep next to a loop in real time, with the loop's own claim to the
    processor.

    It waits for the loop, so that nothing of it is late on a busy machine; without one its time
    goes on all the same, which a test needs that takes the loop away.
    """
    return start_emulator(True, IDLE_S, "--real-time", "--alone-s", str(STALL_S))


def write_bench(
    folder: Path, emulator: RunningEmulator, lockstep: bool = True, **safety: Any
) -> Path:
    """The emulator's bench file with this emulator's ports, and its calibration record next to it.

    lockstep: as the emulator was started. safety: what differs from the patience that it needs.
    """
    bench: dict[str, Any] = tomllib.loads(EMULATOR_BENCH.read_text(encoding="utf-8"))
    bench["bus"]["options"]["port"] = emulator.port
    bench["emulator"] = {"control_port": emulator.control_port, "lockstep": lockstep}
    bench.setdefault("timing", {})["start_silence_s"] = START_SILENCE_S
    bench["safety"] |= PATIENT | ({} if lockstep else LATE) | safety
    path = folder / "bench.toml"
    path.write_text(tomli_w.dumps(bench), encoding="utf-8")
    record = EMULATOR_BENCH.with_name("bench.calibration.toml")
    path.with_name(record.name).write_text(record.read_text(encoding="utf-8"), encoding="utf-8")
    return path
