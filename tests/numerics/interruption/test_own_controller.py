"""Signals during a run with a controller in plain Python, which the compiled loop calls."""

import os
import signal

import pytest

import svsa

DURATION_S = 0.05


@pytest.fixture
def handle():
    """Set the handler of SIGALRM for a test."""
    before = signal.getsignal(signal.SIGALRM)
    yield lambda handler: signal.signal(signal.SIGALRM, handler)
    signal.setitimer(signal.ITIMER_REAL, 0.0)
    signal.signal(signal.SIGALRM, before)


def control(time_s, reference, x, w):
    return 10.0 * (reference.q - x.q), 0.0


def control_and_signal(time_s, *given):
    if round(time_s / 1e-3) == 20:
        os.kill(os.getpid(), signal.SIGALRM)
    return control(time_s, *given)


def test_handler_that_raises_ends_the_run_with_its_exception(handle, capfd):
    class StopError(Exception):
        pass

    def stop(number, frame):
        raise StopError

    handle(stop)
    with pytest.raises(StopError):
        svsa.simulate("4a", control_and_signal, duration_s=DURATION_S)
    assert signal.getsignal(signal.SIGALRM) is stop
    assert capfd.readouterr().err == ""


def test_handler_that_returns_changes_nothing(handle):
    quiet = svsa.simulate("4a", control, duration_s=DURATION_S)
    called = []
    handle(lambda number, frame: called.append(number))
    loud = svsa.simulate("4a", control_and_signal, duration_s=DURATION_S)
    assert called == [signal.SIGALRM]
    assert loud.samples.tobytes() == quiet.samples.tobytes()


def test_every_exception_of_a_handler_is_raised(handle):
    """At any time of the signal: ctypes would print and drop an exception in its callback."""

    class StopError(BaseException):
        pass

    def stop(number, frame):
        raise StopError

    def control_and_wait(time_s, *given):
        if time_s == 0.0:
            signal.setitimer(signal.ITIMER_REAL, delay_s)
        return control(time_s, *given)

    handle(stop)
    for number in range(300):
        delay_s = 3e-6 * (number + 1)
        with pytest.raises(StopError):
            svsa.simulate("4a", control_and_wait, duration_s=1000.0)
