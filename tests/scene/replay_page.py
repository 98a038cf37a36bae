"""A page of a recorded run for the tests, from synthetic samples."""

import math
from pathlib import Path

import numpy as np

from svsa.actuators.signals import CHANNEL_NAMES
from svsa.runs.timeline.events import Event
from svsa_scene.replay import build_replay_html

PERIOD_S = 0.001
CHANNELS = list(CHANNEL_NAMES)


def make_run(ticks: int = 4000, lanes: int = 2) -> tuple[np.ndarray, np.ndarray]:
    """A sine of 0.5 rad at 0.25 Hz; the second lane lags by 0.2 rad from 2 s on, with 3 kg."""
    time = np.arange(ticks) * PERIOD_S
    samples = np.zeros((ticks, lanes, len(CHANNELS)))

    def put(name: str, values: np.ndarray | float) -> None:
        samples[:, :, CHANNELS.index(name)] = np.broadcast_to(values, (lanes, ticks)).T

    reference = 0.5 * np.sin(2 * np.pi * 0.25 * time)
    error = np.arange(lanes)[:, None] * np.where(time >= 2.0, 0.2, 0.0)
    put("time_s", time)
    put("position_reference_rad", reference)
    put("position_rad", reference - error)
    put("position_error_rad", error)
    put("motor1_position_rad", reference - error)
    put("lever_ratio", 0.5)
    put("stiffness_nm_per_rad", 20.0)
    put("stiffness_reference_nm_per_rad", 20.0)
    put("deflection_limit_rad", 0.4)
    return samples, np.where(time >= 2.0, 3.0, 0.0)


def write_page(folder: Path, lanes: tuple[str, ...] = ("NDOBC", "FL"), **changes: object) -> Path:
    samples, mass = make_run(lanes=len(lanes))
    arguments = {
        "title": "A test run",
        "period_s": PERIOD_S,
        "lanes": list(lanes),
        "channels": CHANNELS,
        "samples": samples,
        "load_mass_kg": mass,
        "details": {
            "Version": "9.9.9",
            "Controller": {"Law": "NDOBC", "End, s": math.inf},
        },
        "events": [
            Event(1000, 1.0, "gains", "Gains changed"),
            Event(2000, 2.0, "load_on", "3 kg load on"),
        ],
    }
    path = folder / "run.html"
    path.write_text(build_replay_html(**(arguments | changes)), encoding="utf-8")
    return path
