"""Ticks as a bench's loop leaves them in its memory."""

from svsa.hardware.realtime.memory import LoopMemory


def write(memory: LoopMemory, first: int, ticks: int) -> None:
    """Samples of which every channel is the time."""
    for tick in range(first, first + ticks):
        memory.get_row(tick)[:] = 0.001 * tick
        memory.commit(tick)
