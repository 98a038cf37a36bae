"""Records for tests, written without a simulation."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import RecordHeader
from svsa.runs.records.reader import Record, open_record
from svsa.runs.records.writer import write_record

PERIOD_S = 0.001
Command = tuple[int, dict[str, Any]]


def build_header(
    run_id: str = "run-1", lanes: tuple[str, ...] = ("ndobc", "fl"), **changes: object
) -> RecordHeader:
    values: dict = {
        "version": "0.1.0",
        "run_id": run_id,
        "created": "2026-01-02T03:04:05+00:00",
        "session": "lab",
        "name": "A run",
        "tags": ("class", "load"),
        "notes": "with 3 kg",
        "lanes": lanes,
        "configuration": {"law": "ndobc", "seed": 7, "loads": []},
        "seed": 7,
        "period_s": PERIOD_S,
        "channels": CHANNELS,
    }
    return RecordHeader(**(values | changes))


def build_samples(ticks: int, lanes: int = 2, first_tick: int = 0) -> np.ndarray:
    """Build unusual numbers that depend on the tick alone: (ticks, lanes, channels)."""
    tick = np.arange(first_tick, first_tick + ticks)
    grid = tick[:, None, None] + 10 * np.arange(lanes)[:, None] + np.arange(len(CHANNELS)) / 3
    samples = np.sin(grid * 0.01) * 10.0 ** (np.arange(len(CHANNELS)) % 7 - 3)
    samples[:, :, CHANNEL_INDEX["time_s"]] = (tick * PERIOD_S)[:, None]
    return samples


def add(
    catalogue: Catalogue,
    run_id: str,
    ticks: int = 20,
    commands: Sequence[Command] = (),
    **changes: object,
) -> None:
    header = build_header(run_id, **changes)
    samples = build_samples(ticks, len(header.lanes))
    write_record(catalogue.folder / "runs" / run_id, header, list(commands), 0, samples)
    catalogue.register(header)
    catalogue.finish(run_id)


def list_ids(catalogue: Catalogue, **query: object) -> list[str]:
    return [run.id for run in catalogue.list(**query).runs]  # pyright: ignore[reportArgumentType]


def read_record(folder: Path) -> Record:
    """Read the record in a folder with all its samples."""
    record = open_record(folder)
    _ = record.samples
    return record
