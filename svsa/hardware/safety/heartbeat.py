"""Heartbeats of the processes of a bench, in shared memory.

It also counts the interventions of the supervisor, so that a loop that was late can detect them.
"""

import math
import time
from multiprocessing import resource_tracker, shared_memory
from typing import Literal, Self

import numpy as np

from svsa.errors import StateError

Slot = Literal["loop", "supervisor", "server", "operator", "stopping"]
SLOTS: tuple[Slot, ...] = ("loop", "supervisor", "server", "operator", "stopping")


class Heartbeats:
    """A time (CLOCK_MONOTONIC, s) for each slot; 0 before its first beat.

    The slot `stopping` beats whenever the supervisor has sent zero current and resets.
    """

    def __init__(self, block: shared_memory.SharedMemory, owner: bool) -> None:
        self._block, self._owner = block, owner
        self.name = block.name
        self._times = np.ndarray(len(SLOTS), np.float64, block.buf)
        self._stops = np.ndarray(1, np.int64, block.buf, self._times.nbytes)

    @classmethod
    def create(cls) -> Self:
        """Create a block without a beat; its creator also removes it at `close`."""
        block = create_block(8 * (len(SLOTS) + 1))
        beats = cls(block, owner=True)
        beats._times[:], beats._stops[:] = 0.0, 0
        return beats

    @classmethod
    def attach(cls, name: str) -> Self:
        """The block of that name, made by another process."""
        return cls(attach_block(name), owner=False)

    def beat(self, slot: Slot) -> None:
        """Write a beat of the slot."""
        self._times[SLOTS.index(slot)] = time.monotonic()

    def end(self, slot: Slot) -> None:
        """Mark the slot as ended regularly, so that it is not missed."""
        self._times[SLOTS.index(slot)] = 0.0

    def age_s(self, slot: Slot) -> float:
        """Return the age of the slot's beat, s; infinite before the first one."""
        last = float(self._times[SLOTS.index(slot)])
        return time.monotonic() - last if last else math.inf

    @property
    def stops(self) -> int:
        """Number of times that the supervisor started to stop the drives."""
        return int(self._stops[0])

    def count_stop(self) -> None:
        """Count that the supervisor stops the drives, before its first frame is on the bus."""
        self._stops[0] += 1

    def close(self) -> None:
        """Release the block, and remove it if it was created here."""
        del self._times, self._stops
        self._block.close()
        if self._owner:
            self._block.unlink()


def create_block(size: int) -> shared_memory.SharedMemory:
    """Create a block of shared memory of `size` bytes.

    Raises:
        StateError: If the system has none.
    """
    try:
        return shared_memory.SharedMemory(create=True, size=size)
    except OSError as error:
        raise StateError(
            f"A block of shared memory of {size} bytes cannot be created:"
            f" {error.strerror or error}. Linux keeps it in /dev/shm: mount a tmpfs there that this"
            " user can write (in Docker: --tmpfs /dev/shm), and start again."
        ) from None


def check_shared_memory() -> None:
    """Raise `StateError` if neither a bench nor a worker process can start."""
    block = create_block(1)
    block.close()
    block.unlink()


def attach_block(name: str) -> shared_memory.SharedMemory:
    """Attach a block of shared memory that another process created and will remove.

    It is unregistered from Python's resource tracker, which would remove it when this process ends.
    """
    block = shared_memory.SharedMemory(name)
    resource_tracker.unregister(block._name, "shared_memory")  # pyright: ignore[reportAttributeAccessIssue]
    return block
