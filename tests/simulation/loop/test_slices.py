"""Long runs are split into short compiled calls without changing a bit."""

import numpy as np
import pytest

import svsa
from svsa.runs.execution.batch import run_configurations
from svsa.simulation.loop import slices
from svsa.simulation.loop.slices import cut
from tests.exhaustive import exhaust
from tests.runs.session.sessions import PULSE, build_configuration

TICKS = 600
FAULT = svsa.ConstantLoad(torque_nm=(40.0, 0.0, 0.0), start_s=0.1)


class Clock:
    """A clock on which every tick takes this time, s."""

    def __init__(self, monkeypatch):
        self.now_s = 0.0
        monkeypatch.setattr(slices.time, "perf_counter", lambda: self.now_s)

    def run(self, ticks, tick_s):
        done = []
        for first, stop in cut("test", ticks):
            self.now_s += (stop - first) * tick_s
            done.append((first, stop))
        return done


@pytest.fixture
def clock(monkeypatch):
    monkeypatch.setattr(slices, "_lengths", {})
    return Clock(monkeypatch)


@pytest.mark.parametrize("tick_s", [1e-7, 1e-6, 1e-4])
def test_slice_is_no_longer_than_the_response_time_to_ctrl_c(clock, tick_s):
    for _ in range(2):
        done = clock.run(1_000_000, tick_s)
        assert [first for first, _ in done] == [0, *(stop for _, stop in done[:-1])]
        assert done[-1][1] == 1_000_000
        assert max(stop - first for first, stop in done) * tick_s < 1.01 * slices.SLICE_S


def test_slice_after_a_slow_one_is_shorter(clock):
    clock.run(1_000_000, 1e-7)
    first, second, *_ = clock.run(1_000_000, 1e-5)
    assert second[1] - second[0] < 0.1 * (first[1] - first[0])


def test_short_run_of_a_known_law_is_one_call(clock):
    clock.run(10_000, 1e-7)
    assert clock.run(10_000, 1e-7) == [(0, 10_000)]


def run_whole_and_sliced(monkeypatch, run):
    """Return the results of `run` in one compiled call, and in a call for each tick."""
    with monkeypatch.context() as patch:
        patch.setattr(slices, "_FIRST_TICKS", TICKS)
        patch.setattr(slices, "_lengths", {})
        whole = run()
    lengths = {}
    with monkeypatch.context() as patch:
        patch.setattr(slices, "_FIRST_TICKS", 1)
        patch.setattr(slices, "_MOST_GROWTH", 1.0)
        patch.setattr(slices, "_lengths", lengths)
        sliced = run()
    assert set(lengths.values()) == {1}
    return whole, sliced


@pytest.mark.parametrize("law", exhaust(["ndobc", "ndobc_w", "ilc"], ["ndobc"]))
def test_run_in_slices_has_the_bits_of_one_call(monkeypatch, law):
    configuration = build_configuration(PULSE, law=law, effects=svsa.RIG, seed=3)
    whole, sliced = run_whole_and_sliced(
        monkeypatch, lambda: svsa.simulate(configuration, duration_s=1e-3 * TICKS)
    )
    assert whole.samples.tobytes() == sliced.samples.tobytes()


@pytest.mark.long
@pytest.mark.parametrize("law", exhaust(["ndobc", "ndobc_w", "ilc"], ["ndobc"]))
def test_batch_in_slices_has_the_bits_of_one_call(monkeypatch, law):
    """Also for runs that end in a fault, some of them within a group of eight."""
    configurations = [
        build_configuration(*loads, law=law, effects=svsa.RIG, seed=number)
        for number, loads in enumerate([(PULSE,), (FAULT,), (), (PULSE, FAULT)] * 3)
    ]
    whole, sliced = run_whole_and_sliced(
        monkeypatch, lambda: run_configurations(configurations, 1e-3 * TICKS, 0.05)
    )
    assert whole.tobytes() == sliced.tobytes()
    assert len(np.unique(whole["code"])) > 1
