"""Interrupted or damaged records: readable samples are kept, damage is reported."""

import contextlib
import multiprocessing
import os
import shutil
import signal
import time
from collections.abc import Iterator
from multiprocessing.connection import Connection
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest

from svsa.runs.records import reader
from svsa.runs.records.header import RecordError, RecordHeader
from svsa.runs.records.reader import recover
from svsa.runs.records.recorder import Recorder
from svsa.runs.records.writer import write_record
from tests.exhaustive import exhaust
from tests.waiting import wait_until

from .records import PERIOD_S, build_header, build_samples, read_record

ROUNDS_OF_KILLING = [5, 20]
"""The smaller number in `make test`."""
MAX_LOST_TICKS = round(0.5 / PERIOD_S)
PATIENCE_S = 60.0


def make_stream(folder: Path, ticks: int = 300, batches: int = 3) -> Path:
    """Write a record as `kill -9` leaves it: a stream of some batches and no Parquet file."""
    recorder = Recorder(folder, build_header())
    recorder.write_command(0, {"kind": "load"})
    for batch in range(batches):
        recorder.write_samples(batch * ticks, build_samples(ticks, first_tick=batch * ticks))
        wait_until(lambda done=batch: recorder.status.ticks == (done + 1) * ticks)
    copy = folder.with_name(folder.name + "-killed")
    shutil.copytree(folder, copy)
    recorder.close()
    return copy


def record_until_killed(folder: Path, reported: Connection) -> None:
    """Pass samples to a recorder in real time, and report their number."""
    recorder = Recorder(folder, build_header())
    samples = build_samples(20_000)
    begin, tick = time.monotonic(), 0
    while True:
        now = min(int((time.monotonic() - begin) / PERIOD_S), len(samples))
        if now > tick:
            recorder.write_command(tick, {"tick": tick})
            recorder.write_samples(tick, samples[tick:now])
            tick = now
            reported.send(tick)
        time.sleep(0.008)


def read_reported(reported: Connection) -> list[int]:
    """Return the reports of the process before it was killed."""
    ticks = [0]
    with contextlib.suppress(EOFError):
        while True:
            ticks.append(reported.recv())
    return ticks


@pytest.mark.parametrize("rounds", exhaust(ROUNDS_OF_KILLING, ROUNDS_OF_KILLING[:1]))
def test_kill_9_loses_less_than_half_a_second_and_is_recovered(tmp_path: Path, rounds: int) -> None:
    """Several processes, each killed at another time. A process that the machine did not schedule,
    which its reports show, is granted that time.
    """
    forks = multiprocessing.get_context("forkserver")
    forks.set_forkserver_preload([__name__])
    dice = np.random.default_rng(20)
    moments = sorted(dice.uniform(0.02, 1.5) for _ in range(rounds))
    lost = []
    for group in range(0, rounds, 5):
        children = []
        for number in range(group, group + 5):
            folder = tmp_path / f"run-{number}"
            reported, report = forks.Pipe(duplex=False)
            child = forks.Process(target=record_until_killed, args=(folder, report), daemon=True)
            child.start()
            report.close()
            children.append((number, folder, child, reported))
        for *_, reported in children:
            assert reported.poll(PATIENCE_S)
        begin = time.monotonic()
        for number, _, child, _ in children:
            time.sleep(max(0.0, begin + moments[number] - time.monotonic()))
            child.kill()
        for _, folder, child, reported in children:
            handed_over = read_reported(reported)
            child.join(PATIENCE_S)
            assert child.exitcode == -signal.SIGKILL
            finished = recover(folder)
            assert finished is not None
            record = read_record(folder)
            assert finished.ticks == record.tick_count
            assert not (folder / "samples.arrows").exists()
            assert record.samples.tobytes() == build_samples(record.tick_count).tobytes()
            acting = [tick for tick, command in record.commands if command["tick"] == tick]
            assert len(acting) == len(record.commands)
            lost.append(handed_over[-1] - record.tick_count - max(np.diff(handed_over)))
    assert max(lost) <= MAX_LOST_TICKS


@pytest.mark.parametrize("seed", range(5))
def test_truncated_stream_keeps_every_complete_batch(tmp_path: Path, seed: int) -> None:
    folder = make_stream(tmp_path / "run-1")
    stream = folder / "samples.arrows"
    size = stream.stat().st_size
    os.truncate(stream, int(np.random.default_rng(seed).integers(size // 3, size)))
    with (folder / "commands.jsonl").open("ab") as file:
        file.write(b'{"tick": 3, "comm')
    growing = read_record(folder)
    finished = recover(folder)
    record = read_record(folder)
    assert finished is not None
    assert finished.ticks == record.tick_count == growing.tick_count
    assert record.tick_count in (0, 300, 600)
    assert record.samples.tobytes() == build_samples(record.tick_count).tobytes()
    assert record.commands == [(0, {"kind": "load"})]
    assert (folder / "commands.jsonl").read_bytes().endswith(b"}\n")


def test_trailing_zeros_are_removed(tmp_path: Path) -> None:
    folder = make_stream(tmp_path / "run-1")
    with (folder / "samples.arrows").open("ab") as file:
        file.write(bytes(5000))
    assert read_record(folder).tick_count == 900


def test_interrupted_recovery_is_repeated(tmp_path: Path) -> None:
    folder = make_stream(tmp_path / "run-1")
    (folder / "samples.parquet.tmp").write_bytes(b"half of a file")
    saved = (folder / "samples.arrows").read_bytes()
    assert recover(folder) is not None
    (folder / "samples.arrows").write_bytes(saved)
    again = recover(folder)
    assert again is not None
    assert again.ticks == 900
    names = sorted(path.name for path in folder.iterdir())
    assert names == ["commands.jsonl", "header.json", "samples.parquet"]


def test_record_finished_while_it_is_opened_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = make_stream(tmp_path / "run-1")
    read_stream = reader.read_stream

    def read_late(path: Path, header: RecordHeader) -> Iterator[pa.RecordBatch]:
        recover(path.parent)
        return read_stream(path, header)

    monkeypatch.setattr(reader, "read_stream", read_late)
    record = reader.open_record(folder)
    assert record.tick_count == 900
    np.testing.assert_array_equal(record.samples, build_samples(900))


def damage(path: Path, where: float, count: int = 64) -> bytes:
    content = bytearray(path.read_bytes())
    start = int(len(content) * where)
    content[start : start + count] = bytes(255 - byte for byte in content[start : start + count])
    path.write_bytes(content)
    return bytes(content)


@pytest.mark.parametrize("where", [0.0, 0.35])
def test_damaged_stream_is_reported_and_kept(tmp_path: Path, where: float) -> None:
    folder = make_stream(tmp_path / "run-1")
    stream = folder / "samples.arrows"
    content = bytearray(stream.read_bytes())
    start = content.find(b"\xff\xff\xff\xff", int(len(content) * where))
    content[start + 2] = 0
    stream.write_bytes(content)
    for read in (recover, read_record):
        with pytest.raises(RecordError, match=r"samples\.arrows of record run-1-killed is damaged"):
            read(folder)
    assert stream.read_bytes() == content
    assert not (folder / "samples.parquet").exists()


def test_stream_with_a_gap_is_reported(tmp_path: Path) -> None:
    folder = make_stream(tmp_path / "run-1", ticks=100)
    stream = folder / "samples.arrows"
    content = stream.read_bytes()
    marks = [0]
    while (found := content.find(b"\xff\xff\xff\xff", marks[-1] + 1)) > 0:
        marks.append(found)
    stream.write_bytes(content[: marks[1]] + content[marks[1] : marks[2]] + content[marks[3] :])
    with pytest.raises(RecordError, match="tick 100 is missing"):
        recover(folder)


@pytest.mark.parametrize("where", [0.0, 0.4, 0.7, 0.999])
def test_damaged_parquet_file_is_reported_and_kept(tmp_path: Path, where: float) -> None:
    folder = tmp_path / "run-1"
    write_record(folder, build_header(), [], 0, build_samples(5000))
    content = damage(folder / "samples.parquet", where)
    with pytest.raises(RecordError, match="record run-1"):
        read_record(folder)
    assert (folder / "samples.parquet").read_bytes() == content


def test_damaged_commands_and_headers_are_reported(tmp_path: Path) -> None:
    folder = tmp_path / "run-1"
    write_record(folder, build_header(), [(0, {"a": 1}), (1, {"a": 2})], 0, build_samples(5))
    commands = (folder / "commands.jsonl").read_text()
    (folder / "commands.jsonl").write_text(commands.replace('"tick": 0', '"tick": zero'))
    with pytest.raises(RecordError, match="line 1"):
        read_record(folder)
    (folder / "commands.jsonl").write_text(commands)
    for text in ("", "[]", "{", '{"format": 99}', '{"format": 1}'):
        (folder / "header.json").write_text(text)
        with pytest.raises(RecordError, match=r"header\.json of record run-1 is damaged"):
            read_record(folder)
    (folder / "header.json").unlink()
    with pytest.raises(RecordError, match=r"no header\.json"):
        read_record(folder)
    with pytest.raises(RecordError, match="There is no record nowhere"):
        read_record(tmp_path / "nowhere")


def test_command_of_an_older_record_has_its_present_name(tmp_path: Path) -> None:
    folder = tmp_path / "run-1"
    old = {"tick": 3, "kind": "controller", "argument": "fl"}
    write_record(folder, build_header(), [(3, old)], 0, build_samples(5))
    assert read_record(folder).commands == [(3, {"tick": 3, "kind": "law", "argument": "fl"})]
