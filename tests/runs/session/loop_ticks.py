"""Ticks as the loop of a bench writes them into its memory."""

from svsa.hardware.realtime.memory import LoopMemory


def write(memory: LoopMemory, first: int, ticks: int) -> None:
    """Write samples in which every channel is the time."""
    for tick in range(first, first + ticks):
        memory.get_row(tick)[:] = 0.001 * tick
        memory.commit(tick)
