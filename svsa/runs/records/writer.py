"""Writer of a growing record's files, and of a finished record in one call."""

import os
import shutil
from pathlib import Path

import numpy as np

from svsa.errors import Fault
from svsa.inputs.file_lock import take_lock
from svsa.runs.records.header import (
    COMMANDS_FILE,
    STREAM_FILE,
    RecordError,
    RecordHeader,
    write_header,
)
from svsa.runs.records.outcome import write_fault
from svsa.runs.records.parquet import ROWS_PER_GROUP, Commands, Finished, finish, write_command
from svsa.runs.records.stream import END_OF_STREAM, TIME, build_batch, build_schema, write_all

_FLAGS = os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_APPEND | getattr(os, "O_BINARY", 0)


class RecordWriter:
    """A new folder with header, commands and samples.

    Data of a method that has returned are with the operating system and outlive the process.
    Methods raise `OSError` if the disk fails; earlier data stay complete.

    Raises:
        RecordError: If the folder cannot be created.
    """

    def __init__(self, folder: Path, header: RecordHeader) -> None:
        self.folder, self.header, self._schema = folder, header, build_schema(header)
        self._descriptors: list[int] = []
        try:
            folder.mkdir(parents=True)
        except FileExistsError:
            raise RecordError(f"There is a record {folder.name} already.") from None
        except (OSError, ValueError) as error:
            raise RecordError(f"Cannot record into {folder}: {error}.") from None
        try:
            self._stream = self._create(STREAM_FILE)
            # Locked while the record grows, so that `recover` does not touch it. The system
            # releases the lock when the process dies, even if it is killed.
            take_lock(self._stream)
            self._commands = self._create(COMMANDS_FILE)
            write_header(folder, header)
            write_all(self._stream, memoryview(self._schema.serialize()))
        except OSError as error:
            self.release()
            shutil.rmtree(folder, ignore_errors=True)
            raise RecordError(f"Cannot record into {folder}: {error}.") from None

    def write_lines(self, lines: bytes) -> int:
        """Append lines of `write_command`; return their bytes."""
        write_all(self._commands, lines)
        return len(lines)

    def write_samples(self, first_tick: int, samples: np.ndarray) -> int:
        """Append samples (ticks, lanes, channels); return their bytes."""
        if TIME in self.header.channel_names:
            times = samples[:, :, self.header.channel_names.index(TIME)]
            if not np.array_equal(times, times[:, :1].repeat(times.shape[1], 1), equal_nan=True):
                raise RecordError("the lanes are not at the same time.")
        batch = build_batch(self.header, self._schema, first_tick, samples)
        content = memoryview(batch.serialize())
        write_all(self._stream, content)
        return len(content)

    def finish(self) -> Finished:
        """Close the files and write the Parquet file.

        Raises:
            RecordError: If that fails.
        """
        try:
            write_all(self._stream, END_OF_STREAM)
        except OSError as error:
            raise RecordError(f"Record {self.folder.name} cannot be finished: {error}.") from None
        else:
            return finish(self.folder)
        finally:
            self.release()

    def _create(self, name: str) -> int:
        self._descriptors.append(os.open(self.folder / name, _FLAGS, 0o644))
        return self._descriptors[-1]

    def release(self) -> None:
        """Close the files unfinished."""
        for descriptor in self._descriptors:
            os.close(descriptor)
        self._descriptors.clear()


def write_record(
    folder: Path,
    header: RecordHeader,
    commands: Commands,
    first_tick: int,
    samples: np.ndarray,
    fault: Fault | None = None,
) -> Finished:
    """Write a record of a finished run, samples (ticks, lanes, channels), in one call.

    Raises:
        RecordError: If the folder exists or the disk fails.
    """
    writer = RecordWriter(folder, header)
    try:
        writer.write_lines(b"".join(write_command(*command) for command in commands))
        for row in range(0, len(samples), ROWS_PER_GROUP):
            writer.write_samples(first_tick + row, samples[row : row + ROWS_PER_GROUP])
        write_fault(folder, fault)
    except OSError as error:
        writer.release()
        raise RecordError(f"Record {folder.name} cannot be written: {error}.") from None
    return writer.finish()
