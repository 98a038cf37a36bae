"""The shared memory of loop and server: rows by tick, histograms, and one owner."""

import subprocess
import sys

import numpy as np
import pytest

from svsa.actuators.signals import CHANNELS
from svsa.hardware.realtime.memory import (
    CAPACITY_TICKS,
    LATENESS_EDGES_S,
    LoopMemory,
    add_to_histogram,
    read_quantile,
)


@pytest.fixture
def memory():
    made = LoopMemory.create()
    yield made
    made.close()


def test_rows_are_read_by_tick_around_the_end_of_the_ring(memory):
    for tick in range(CAPACITY_TICKS - 5, CAPACITY_TICKS + 5):
        memory.get_row(tick)[:] = tick
        memory.commit(tick)
    rows = np.empty((10, len(CHANNELS)))
    memory.read(CAPACITY_TICKS - 5, rows)
    np.testing.assert_array_equal(rows[:, 3], np.arange(CAPACITY_TICKS - 5, CAPACITY_TICKS + 5))
    assert memory.fields["end_tick"] == CAPACITY_TICKS + 5


def test_block_persists_after_the_end_of_a_writing_process(memory):
    program = (
        "import sys\n"
        "from svsa.hardware.realtime.memory import LoopMemory\n"
        "memory = LoopMemory.attach(sys.argv[1])\n"
        "memory.begin_run(7)\n"
        "memory.get_row(0)[:] = 1.5\n"
        "memory.commit(0)\n"
        "memory.close()\n"
    )
    subprocess.run([sys.executable, "-c", program, memory.name], check=True, timeout=60)
    assert (memory.fields["run"], memory.fields["end_tick"]) == (7, 1)
    again = LoopMemory.attach(memory.name)
    assert np.all(again.get_row(0) == 1.5)
    again.close()


def test_quantiles_are_upper_edges_within_a_bin():
    histogram = np.zeros(len(LATENESS_EDGES_S), np.int64)
    assert read_quantile(histogram, 0.99) == 0.0
    for lateness in np.linspace(1e-5, 1e-3, 1000):
        add_to_histogram(histogram, lateness)
    for share in (0.5, 0.99, 0.999):
        exact = 1e-5 + share * (1e-3 - 1e-5)
        assert exact <= read_quantile(histogram, share) * 1.001 <= exact * 1.13
    add_to_histogram(histogram, 1e9)
    add_to_histogram(histogram, 0.0)
    assert histogram.sum() == 1002
