"""The server's view of a bench run: its samples, missed ticks, and its twin."""

from collections.abc import Iterator

import numpy as np
import pytest

from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS
from svsa.hardware.description.file import read_bench
from svsa.hardware.realtime.configuration import build_bench_configuration
from svsa.hardware.realtime.memory import CAPACITY_TICKS, LoopMemory
from svsa.hardware.session.run import TWIN, BenchRun
from svsa.runs.definition.paper import get_figure
from svsa.runs.execution.run import Start
from svsa.runs.session.journal import Journal
from svsa.simulation.loop.lane import AT_REST
from tests.hardware.wired_bench import EMULATOR_BENCH
from tests.runs.session.loop_ticks import write


@pytest.fixture
def memory() -> Iterator[LoopMemory]:
    made = LoopMemory.create()
    made.begin_run(1)
    yield made
    made.close()


def build_run(memory: LoopMemory) -> BenchRun:
    bench = read_bench(EMULATOR_BENCH)
    wanted = get_figure("4a").build_configuration(load=False)
    start = Start(bench.home.lever_ratio, AT_REST)
    return BenchRun(build_bench_configuration(bench, wanted), start, memory)


def test_missed_ticks_have_a_time_and_no_numbers(memory: LoopMemory) -> None:
    write(memory, 0, 10)
    memory.skip(10, 5)
    assert memory.fields["end_tick"] == 10, "nothing is reported before there is a sample"
    write(memory, 15, 3)
    run, rows = build_run(memory), np.zeros((2, 18, len(CHANNELS)))
    assert run.advance(rows) == 18
    times = np.arange(18) * run.period_s
    assert rows[0, :, 0].tolist() == times.tolist()
    assert np.flatnonzero(np.isnan(rows[0, :, 1:]).all(axis=1)).tolist() == [10, 11, 12, 13, 14]
    residual = CHANNEL_INDEX["position_residual_rad"]
    assert np.flatnonzero(np.isnan(rows[0, :, residual])).tolist() == [10, 11, 12, 13, 14]
    assert np.isfinite(rows[TWIN, :, CHANNEL_INDEX["position_rad"]]).all(), "the twin goes on"
    assert rows[TWIN, :, 0].tolist() == times.tolist()


def test_loop_suspended_for_longer_than_the_ring_leaves_no_old_samples(
    memory: LoopMemory,
) -> None:
    write(memory, 0, 10)
    memory.skip(10, 2 * CAPACITY_TICKS)
    rows = np.zeros((CAPACITY_TICKS, len(CHANNELS)))
    memory.read(10 + CAPACITY_TICKS, rows)
    assert np.isnan(rows).all()


class CountedMemory(LoopMemory):
    """Fails a test that requests samples repeatedly."""

    counted = 0

    def count(self, number: int) -> int:
        self.counted += 1
        assert self.counted < 100, "it is asked without end"
        return super().count(number)


def test_missing_samples_are_not_waited_for() -> None:
    memory = CountedMemory.create()
    try:
        memory.begin_run(1)
        write(memory, 0, 10)
        journal = Journal(build_run(memory), is_bench=True)
        journal.advance(30)
        assert (journal.run.tick, journal.history.end_tick) == (10, 10)
        write(memory, 10, 5)
        journal.advance(30)
        assert (journal.run.tick, journal.history.end_tick) == (15, 15)
    finally:
        memory.close()
