"""The clock that counts due ticks, and the ring buffer of the newest samples."""

import numpy as np

import svsa
from svsa.runs.session.clock import SimulationClock
from svsa.runs.session.history import History
from svsa.runs.session.journal import HISTORY_TICKS

from .sessions import ALL, build_session, read_samples


def test_backward_clock_gives_no_ticks():
    clock = SimulationClock(0.001)
    assert [clock.take_due_ticks(now) for now in (5.0, 4.0, 4.0)] == [0, 0, 0]


def test_slow_motion_receives_its_ticks():
    """At a hundredth of the speed a tick is due every 0.1 s; none is lost by rounding."""
    clock = SimulationClock(0.001)
    clock.speed = 0.01
    ticks = [clock.take_due_ticks(k / 30.0) for k in range(301)]
    assert abs(sum(ticks) - 100) <= 1


def test_history_wraps_around_and_keeps_the_newest_samples():
    """Rows are written in place, in segments that end at the end of the buffer."""
    history, written = History(2, 10), 0
    for count in (4, 4, 7, 10, 3, 1, 9):
        while count:
            rows = history.get_free_rows(2, count)
            assert rows.shape[0] == 2
            assert 0 < rows.shape[1] <= count
            rows[0, :, 0] = np.arange(written, written + rows.shape[1])
            rows[1, :, 0] = -rows[0, :, 0]
            history.commit(rows.shape[1])
            written += rows.shape[1]
            count -= rows.shape[1]
        first = max(0, written - 10)
        assert (history.first_tick, history.end_tick) == (first, written)
        expected = np.arange(first, written)
        both = np.stack([expected, -expected], axis=1)
        np.testing.assert_array_equal(history.read(first, 1, [0], [0, 1])[:, :, 0], both)
        np.testing.assert_array_equal(history.read(first, 1, [0], [1])[:, 0, 0], -expected)
        np.testing.assert_array_equal(
            history.read(first + 1, 3, [0], [1, 0])[:, :, 0], both[1::3, ::-1]
        )
        assert history.read_newest()[0] == written - 1
        assert history.read_newest(1)[0] == 1 - written
    history.clear()
    assert history.read_newest() is None
    assert history.read(0, 1, [0], [0]).shape == (0, 1, 1)


def test_long_session_keeps_the_newest_samples_of_the_run():
    """Across the wrap the samples are those of one long call."""
    session = build_session()
    ticks = HISTORY_TICKS + 1500
    for count in (1000, HISTORY_TICKS - 300, 800):
        session.step(count)
    whole = svsa.simulate(session.run.configuration, duration_s=ticks * 0.001).samples
    first = session.journal.history.first_tick
    assert (first, session.journal.history.end_tick) == (1500, ticks)
    np.testing.assert_array_equal(
        session.journal.history.read(first, 7, ALL, [0])[:, 0], whole[first::7]
    )


def test_copy_of_the_history_does_not_change_while_the_session_runs():
    """A reader in another thread keeps its samples."""
    session = build_session()
    session.step(20)
    read = read_samples(session)
    kept = read.copy()
    session.step(HISTORY_TICKS)
    np.testing.assert_array_equal(read, kept)
