"""The recorder: recordings are read back bit for bit, and errors are reported."""

import contextlib
import json
import os
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from svsa.actuators.signals import CHANNELS
from svsa.errors import ParameterError, SvsaError
from svsa.runs.records import recorder as recorder_module
from svsa.runs.records.header import RecordError, RecordHeader, parse_header
from svsa.runs.records.reader import open_record, recover
from svsa.runs.records.recorder import Recorder
from svsa.runs.records.writer import write_record
from tests.waiting import wait_until

from .records import build_header, build_samples, read_record


def test_samples_and_commands_are_read_back_bit_for_bit(tmp_path: Path) -> None:
    header = build_header()
    recorder = Recorder(tmp_path / "run-1", header)
    samples = build_samples(1000, first_tick=70)
    samples[3, 1, 5], samples[4, 0, 6], samples[5, 1, 7] = np.nan, -np.inf, -0.0
    buffer = np.empty((8, 2, samples.shape[2]))
    recorder.write_command(70, {"kind": "load", "argument": {"mass_kg": 3.0}})
    for start in range(0, 1000, 8):
        buffer[:] = samples[start : start + 8]
        recorder.write_samples(70 + start, buffer)
        buffer[:] = 1e9
    recorder.write_command(1070, {"kind": "unload", "argument": 1})
    status = recorder.close()
    assert (status.state, status.message, status.ticks) == ("closed", "", 1000)
    record = read_record(tmp_path / "run-1")
    assert record.header == header
    assert record.first_tick == 70
    assert record.samples.tobytes() == samples.tobytes()
    assert record.commands == [
        (70, {"kind": "load", "argument": {"mass_kg": 3.0}}),
        (1070, {"kind": "unload", "argument": 1}),
    ]
    files = sorted(path.name for path in (tmp_path / "run-1").iterdir())
    assert files == ["commands.jsonl", "header.json", "samples.parquet"]
    assert status.bytes == sum(path.stat().st_size for path in (tmp_path / "run-1").iterdir())


def test_finished_file_is_self_describing(tmp_path: Path) -> None:
    header = build_header()
    write_record(tmp_path / "run-1", header, [(5, {"kind": "load"})], 0, build_samples(50))
    table = pq.read_table(tmp_path / "run-1" / "samples.parquet")
    assert table.column_names[:3] == ["tick", "time_s", "ndobc.position_reference_rad"]
    assert table.column_names[-1] == f"fl.{CHANNELS[-1].name}"
    assert table.schema.field("tick").type == pa.int64()
    assert table.schema.field("fl.torque1_nm").metadata == {b"unit": "N·m".encode()}
    assert parse_header(table.schema.metadata[b"svsa.header"].decode()) == header
    commands = json.loads(table.schema.metadata[b"svsa.commands"])
    assert commands == [{"tick": 5, "command": {"kind": "load"}}]


def test_samples_are_written_during_the_recording(tmp_path: Path) -> None:
    """`test_kill_9_loses_less_than_half_a_second_and_is_recovered` shows how soon."""
    recorder = Recorder(tmp_path / "run-1", build_header())
    recorder.write_command(0, {"kind": "load"})
    recorder.write_samples(0, build_samples(10))
    wait_until(lambda: recorder.status.ticks == 10)
    record = open_record(tmp_path / "run-1")
    assert (record.tick_count, record.commands) == (10, [(0, {"kind": "load"})])
    assert recover(tmp_path / "run-1") is None, "a record that is being written was recovered"
    assert recorder.status.state == "recording"
    recorder.close()


def test_recording_without_samples_is_empty(tmp_path: Path) -> None:
    assert Recorder(tmp_path / "run-1", build_header()).close().state == "closed"
    assert read_record(tmp_path / "run-1").samples.shape == (0, 2, build_samples(1).shape[2])


def test_existing_or_unwritable_folder_is_rejected(tmp_path: Path) -> None:
    Recorder(tmp_path / "run-1", build_header()).close()
    with pytest.raises(RecordError, match="a record run-1 already"):
        Recorder(tmp_path / "run-1", build_header())
    (tmp_path / "file").write_text("")
    with pytest.raises(RecordError, match="Cannot record into"):
        Recorder(tmp_path / "file" / "run-1", build_header())


def test_slow_disk_ends_the_recording_and_not_the_run(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(recorder_module, "MAX_WAITING_BYTES", 1 << 20)
    recorder = Recorder(tmp_path / "run-1", build_header())
    for tick in range(0, 10_000, 100):
        recorder.write_samples(tick, build_samples(100, first_tick=tick))
    status = recorder.close()
    assert status.state == "failed"
    assert "too slow" in status.message
    record = read_record(tmp_path / "run-1")
    assert 0 < record.tick_count == status.ticks < 10_000
    assert record.samples.tobytes() == build_samples(record.tick_count).tobytes()


@pytest.mark.parametrize("wrong", ["jump", "shape", "command", "lanes"])
def test_unrecordable_samples_end_the_recording_with_the_reason(tmp_path, wrong) -> None:
    recorder = Recorder(tmp_path / "run-1", build_header())
    recorder.write_samples(0, build_samples(10))
    match wrong:
        case "jump":
            recorder.write_samples(11, build_samples(10))
        case "shape":
            recorder.write_samples(10, build_samples(10, lanes=3))
        case "command":
            recorder.write_command(10, {"kind": object()})
        case "lanes":
            wait_until(lambda: recorder.status.ticks == 10)
            samples = build_samples(10, first_tick=10)
            samples[:, 1, 0] += 1
            recorder.write_samples(10, samples)
    status = recorder.close()
    words = {"jump": "jump", "shape": "shape", "command": "JSON", "lanes": "same time"}
    assert status.state == "failed"
    assert words[wrong] in status.message
    assert read_record(tmp_path / "run-1").tick_count == 10


@contextlib.contextmanager
def mount_small_disk(folder: Path, size: str) -> Iterator[Path]:
    folder.mkdir()
    command = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)]
    if os.name != "posix" or os.geteuid() != 0 or shutil.which("mount") is None:
        pytest.skip("mounting a small disk needs root")
    if subprocess.run(command, capture_output=True).returncode:
        pytest.skip("this machine does not let root mount a tmpfs")
    try:
        yield folder
    finally:
        subprocess.run(["umount", str(folder)], check=True)


def test_full_disk_ends_the_recording_and_keeps_the_written_samples(tmp_path: Path) -> None:
    with mount_small_disk(tmp_path / "disk", "1m") as disk:
        recorder = Recorder(disk / "run-1", build_header())
        for tick in range(0, 6000, 500):
            recorder.write_samples(tick, build_samples(500, first_tick=tick))
            wait_until(
                lambda end=tick: recorder.status.ticks > end or recorder.status.state == "failed"
            )
        status = recorder.close()
        assert status.state == "failed"
        assert "No space left" in status.message
        kept = read_record(disk / "run-1")
        assert 0 < kept.tick_count == status.ticks < 6000
        assert kept.samples.tobytes() == build_samples(kept.tick_count).tobytes()
        with pytest.raises(SvsaError):
            recover(disk / "run-1")
        subprocess.run(["mount", "-o", "remount,size=8m", str(disk)], check=True)
        assert recover(disk / "run-1") is not None
        assert read_record(disk / "run-1").tick_count == kept.tick_count


def test_read_only_disk_rejects_a_recording(tmp_path: Path) -> None:
    with mount_small_disk(tmp_path / "disk", "1m") as disk:
        subprocess.run(["mount", "-o", "remount,ro", str(disk)], check=True)
        with pytest.raises(RecordError, match="Read-only"):
            Recorder(disk / "run-1", build_header())


@pytest.mark.parametrize(
    "changes",
    [
        {"run_id": "../x"},
        {"run_id": ""},
        {"run_id": "a/b"},
        {"run_id": "a\0b"},
        {"run_id": "x" * 65},
        {"run_id": "ü"},
        {"name": "x" * 201},
        {"name": "\ud800"},
        {"tags": ("x",) * 2},
        {"tags": ("",)},
        {"notes": "x" * 10_001},
        {"lanes": ()},
        {"lanes": ("a", "a")},
        {"period_s": float("nan")},
        {"period_s": 0.0},
        {"channels": ()},
        {"seed": -1},
        {"more": 1},
    ],
)
def test_invalid_header_is_rejected_with_the_name_of_the_value(changes: dict) -> None:
    with pytest.raises(ParameterError) as refusal:
        build_header(**changes)
    assert refusal.value.violations[0].name == next(iter(changes))


def test_header_is_unchanged_by_json() -> None:
    header = build_header(name="Ünï 🦾 ../x \0", configuration={"a": [1.5, None, "x"]})
    assert parse_header(header.to_json()) == header
    assert isinstance(header, RecordHeader)


def test_long_record_is_read_across_its_segments(tmp_path: Path) -> None:
    samples = build_samples(150_000, lanes=1)
    header = build_header(lanes=("fl",))
    write_record(tmp_path / "run-1", header, [], 0, samples)
    record = open_record(tmp_path / "run-1")
    read = record.read_channels(["time_s", "torque1_nm"], 65_000, 140_000)
    np.testing.assert_array_equal(read, samples[65_000:140_000, :, [0, 18]])
    assert record.read_channels(["time_s"], 150_000, 160_000).shape == (0, 1, 1)
    assert [tick for tick, _ in record.iterate()] == [0, 65_536, 131_072]
