"""The bench file of a rig on the wall clock, on a machine that may be busy."""

import tomllib
from pathlib import Path
from typing import Any

import tomli_w

from svsa.rig.launch import RunningRig

from .wired_bench import RIG_BENCH

PATIENT = {
    "stale_zero_s": 0.9,
    "stale_fault_s": 1.0,
    "missed_ticks": 900,
    "supervisor_s": 2.0,
    "standstill_max_nm": 1000.0,
    "disturbance_max_nm": 1000.0,
}
"""A rig that is not let run for a moment looks like encoders that are frozen or wrong."""


def write_bench(folder: Path, rig: RunningRig, **safety: Any) -> Path:
    """The rig's bench file with this rig's ports, and its calibration record beside it.

    safety: what differs from `PATIENT`.
    """
    bench: dict[str, Any] = tomllib.loads(RIG_BENCH.read_text(encoding="utf-8"))
    bench["bus"]["options"]["port"] = rig.port
    bench["emulator"]["control_port"] = rig.control_port
    bench["safety"] |= PATIENT | safety
    path = folder / "bench.toml"
    path.write_text(tomli_w.dumps(bench), encoding="utf-8")
    record = RIG_BENCH.with_name("bench.calibration.toml")
    path.with_name(record.name).write_text(record.read_text(encoding="utf-8"), encoding="utf-8")
    return path
